"""A week as a whole, driven by the days' manifests; it knows no day.

labs        run the labs, collect the numbers they record
numbers     the student's own numbers beside the kit's, from the log
facts       what a week was: tasks, functions, minutes, hints, mistakes
page        all that as one HTML page: `make report`
retro       its numbers between two marks of the student's retrospective
clone       a clone of the last commit, set up from nothing: `make fresh`
missing     what is here and not in that clone
compare     the clone's numbers beside the committed ones
"""

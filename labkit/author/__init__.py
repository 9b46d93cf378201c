"""The tests of `make author` for a new day, and other tools of an author.

files       consistency of a day's files: regions, rows, headings, links
hints       their size, and solutions in them
docstring   worked cases of a docstring are run, and shapes are compared
by_machine  mistakes of a day that the checker names without their entry
student     the complete lab as a student's own file: check, grade, proof
display     opens the day's tabs, draws its pictures and compares them
week        a week's capstone: missing names and functions
blank       an empty worksheet
tables      tables of kinds and limits, for documents
renumber    gives a day another number, or another week
"""

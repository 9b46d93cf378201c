"""A page to show: a student's week, run again here, and what it does not prove.

facts       what is found in a clone, now
capstone    the week's, with its functions, in the sandbox; as a film
page        one HTML file
card        a picture to share;  sharing  the tags by which the page names it
door        the page that leads to those of all weeks
"""

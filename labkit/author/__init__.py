"""What `make author` looks at: is a day that somebody writes as it must be?

files       do a day's files fit together: regions, rows, headings, links
hints       their size, and whether they have the solution
docstring   what a docstring says: worked cases are run, shapes are compared
by_machine  mistakes of a day that the checker names without their entry
student     the complete lab as a student's own file: check, grade, proof
seen        the day's tabs opened, its pictures drawn and compared
week        what a week's capstone lacks
blank       an empty worksheet
tables      of kinds and limits, for documents
moved       a day under another number, or in another week
"""

"""Days: each is one folder, `w*/dayN/`, that the machine reads by path.

    week       its manifest, week.toml: its days, in order, and what is to come; how a
               manifest is read
    day        its manifest, day.toml: tasks, hints, deliverables, limits; the Python
               files of its folder, imported by path
    marks      what a row of the log is worth: its number's range, which file wrote it
    script     its lab script: the starter, with the tasks taken out, and what shows in
               a student's file
    borrowed   the kit's own functions in a student's file, so that they can go on
    own_files  a student's files, read without trusting the folder
    lab        what every lab script does the same way: say, check, record

Nothing here, and nothing else in `labkit`, names a day or imports one.
"""

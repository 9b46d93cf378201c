"""Days: each is one folder, `w*/dayN/`, that the machine reads by path.

    week       its manifest, week.toml: its days, in order, and what is to come; how a
               manifest is read
    day        its manifest, day.toml: tasks, hints, deliverables, limits
    marks      which file wrote a row of the log
    folder     its Python files (one per function, and others), imported by path
    starter    the student's copy of its lab script, with the tasks taken out
    borrowed   the kit's own functions in a student's file, so that they can go on
    own_files  a student's files, read without trusting the folder
    lab        what every lab script does the same way: say, check, record

Nothing here, and nothing else in `labkit`, names a day or imports one.
"""

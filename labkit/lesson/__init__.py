"""Days: each is one folder, `w*/dayN/`, that the machine reads by path.

    week        its manifest, week.toml: its days, in order, and announced days; the
                reader of manifests
    day         its manifest, day.toml: tasks, hints, deliverables, limits; the Python
                files of its folder, imported by path
    last_day    the day that a student worked on last
    lab         the common actions of every lab script: print, check, record
    metric      a number that the log must have, and its range
    predictions the worksheet's table of predictions
    hidden_numbers  measured numbers that a lab's output hides until they are predicted
    writers     the file that wrote a row, and whether the row still counts
    sealed      a complete lab that nobody reads by accident
    day_mujoco  a day's own access to MuJoCo, found beside its complete lab
    lab_module  a lab script read and loaded: as text, and as a module
    starter     the complete lab with the tasks taken out, and put back
    cells       functions in the cells of a notebook
    constants   a day's table of constants: each is doubled
    borrowed    the kit's own functions in a student's file, so that they can go on
    added_code  code that the checker adds below a student's file
    slips       mistakes that a student's file shows without a run
    renames     old names of functions and arguments in a student's file
    merge       a newer lab's text around a student's code
    backup      a student's file replaced, with a copy of the former one
    student_files    the files of a clone that the student writes
    untrusted_files  a student's files, read without trusting the folder

Nothing here, and nothing else in `labkit`, names a day or imports one.
"""

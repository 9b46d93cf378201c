"""Days: each is one folder, `w*/dayN/`, that the machine reads by path.

    week        its manifest, week.toml: its days, in order, and what is to come; how a
                manifest is read
    day         its manifest, day.toml: tasks, hints, deliverables, limits; the Python
                files of its folder, imported by path
    last_day    the day that a student worked on last
    lab         what every lab script does the same way: say, check, record
    metric      what a row of the log must be: a number, and its range
    writers     which file wrote a row, and what the row is worth now
    sealed      a complete lab that nobody reads by accident
    day_mujoco  what a day asks of MuJoCo, found beside its complete lab
    lab_module  a lab script read and loaded: as text, and as a module
    starter     made of the complete lab: the tasks taken out, and put back
    notebook    the complete lab as a notebook, cell by cell
    borrowed    the kit's own functions in a student's file, so that they can go on
    added_code  what the checker puts below a student's file before it is asked
    slips       what shows in a student's file unrun
    merge       a newer lab's text around what a student wrote
    own_files   a student's files, read without trusting the folder

Nothing here, and nothing else in `labkit`, names a day or imports one.
"""

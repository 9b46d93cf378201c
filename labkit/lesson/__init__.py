"""What a day is: one folder, `w*/dayN/`, that the machine reads by path.

    day        finds and loads its manifest, day.toml
    content    what a manifest holds: tasks, hints, deliverables, limits
    entries    the tables of a manifest, fetched by name and type
    folder     its Python files (questions.py and others), imported by path
    starter    the student's copy of its lab script, with the tasks taken out
    lab        what every lab script does the same way: say, check, record

Nothing here, and nothing else in `robo47`, names a day or imports one.
"""

import kit

kit.run("grade")  # labkit/commands/grade.py

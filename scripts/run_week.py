import kit

kit.run("week")  # labkit/commands/week.py

import kit

kit.run("new")  # labkit/commands/new.py

import kit

kit.run("hint")  # labkit/commands/hint.py

import kit

kit.run("check")  # labkit/commands/check.py

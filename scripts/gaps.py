import kit

kit.run("gaps")  # labkit/commands/gaps.py

import kit

kit.run("hunt")  # labkit/commands/hunt.py

import kit

kit.run("pins")  # labkit/commands/pins.py

import kit

kit.run("constants")  # labkit/commands/constants.py

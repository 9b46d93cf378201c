import kit

kit.run("fresh")  # labkit/commands/fresh.py

import kit

kit.run("edition")  # labkit/commands/edition.py

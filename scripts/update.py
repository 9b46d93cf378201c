import kit

kit.run("update")  # labkit/commands/update.py

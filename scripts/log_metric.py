import kit

kit.run("log")  # labkit/commands/log.py

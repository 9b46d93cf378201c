import kit

kit.run("start")  # labkit/commands/start.py

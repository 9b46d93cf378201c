import kit

kit.run("run")  # labkit/commands/run.py

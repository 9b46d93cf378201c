import kit

kit.run("notebook")  # labkit/commands/notebook.py

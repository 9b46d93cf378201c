import kit

kit.run("docs")  # labkit/commands/docs.py

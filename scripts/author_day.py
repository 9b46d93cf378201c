import kit

kit.run("author")  # labkit/commands/author.py

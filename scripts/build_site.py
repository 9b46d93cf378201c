import kit

kit.run("site")  # labkit/commands/site.py

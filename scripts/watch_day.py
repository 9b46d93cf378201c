import kit

kit.run("watch")  # labkit/commands/watch.py

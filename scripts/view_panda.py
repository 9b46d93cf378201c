import kit

kit.run("view")  # labkit/commands/view.py

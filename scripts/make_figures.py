import kit

kit.run("figures")  # labkit/commands/figures.py

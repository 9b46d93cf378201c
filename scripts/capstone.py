import kit

kit.run("capstone")  # labkit/commands/capstone.py

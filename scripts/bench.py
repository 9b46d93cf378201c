import kit

kit.run("bench")  # labkit/commands/bench.py

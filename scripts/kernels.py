import kit

kit.run("kernels")  # labkit/commands/kernels.py

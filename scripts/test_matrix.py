import kit

kit.run("test_matrix")  # labkit/commands/test_matrix.py

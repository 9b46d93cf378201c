import kit

kit.run("borrow")  # labkit/commands/borrow.py

import kit

kit.run("oracle")  # labkit/commands/oracle.py

import kit

kit.run("report")  # labkit/commands/report.py

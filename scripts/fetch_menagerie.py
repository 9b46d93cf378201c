import kit

kit.run("robot")  # labkit/commands/robot.py

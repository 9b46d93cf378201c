"""The modules inside the sandbox's process, beside the student's code.

This folder is run as a program by a bare interpreter that cannot import `robo47`, so
its modules import each other by their short names and need nothing but NumPy.
"""

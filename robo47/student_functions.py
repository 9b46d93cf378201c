"""The student's own functions; the code is `labkit.check.own_functions`."""

from labkit.check.own_functions import Mine, load, statuses

__all__ = ["Mine", "load", "statuses"]

"""What every lab script does the same way; the code is `labkit.lesson.lab`."""

from labkit.lesson.lab import Lab

__all__ = ["Lab"]

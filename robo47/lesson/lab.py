"""The common part of every lab script; the code is `labkit.lesson.lab`."""

from labkit.lesson.lab import Lab

__all__ = ["Lab"]

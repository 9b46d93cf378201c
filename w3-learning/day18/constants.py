"""The sensitivity of Day 18's numbers: each constant doubled, measured, explained."""

from labkit.lesson.constants import Numbers

numbers = Numbers()

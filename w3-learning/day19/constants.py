"""The sensitivity of Day 19's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything, and nothing is random.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(19))
# Each constant in words, with {} for its value.
numbers = Numbers(
    link="length of the first link (the second is half as long): {} m",
    q1="angle of joint 1: {} rad",
)


@numbers.add(
    "height of the end", "{:.3f} m",
    link=times(2.0, "the arm is twice as large and has the same shape"),
    q1=between(1.2, 1.5, "the whole arm points further up"),
)  # fmt: skip
def height(link=1.0, q1=0.5):
    """Return the height of the arm's end."""
    return LAB.reach(q1, 1.0, link, link / 2)[1]


@numbers.add(
    "distance of the end from the base", "{:.3f} m",
    link=times(2.0, "the arm is twice as large and has the same shape"),
    q1=same("joint 1 rotates the whole arm about the base"),
)  # fmt: skip
def distance(link=1.0, q1=0.5):
    """Return the distance of the arm's end from its base."""
    return np.linalg.norm(LAB.reach(q1, 1.0, link, link / 2))

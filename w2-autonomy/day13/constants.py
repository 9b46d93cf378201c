"""What the guide's numbers hang on: each constant turned by two; docs/teaching.md."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(13))
# Each constant in words, with {} for its value.
numbers = Numbers(
    link="the first link is {} m long, the second half as long",
    q1="the first joint is at {} rad",
)


@numbers.add(
    "height of the guide's arm", "{:.3f} m",
    link=times(2.0, "the arm is twice as large and has the same shape"),
    q1=between(1.2, 1.5, "the whole arm is turned further up"),
)  # fmt: skip
def height(link=1.0, q1=0.5):
    """Return how high the arm ends."""
    return LAB.reach(q1, 1.0, link, link / 2)[1]


@numbers.add(
    "its distance from the base", "{:.3f} m",
    link=times(2.0, "the arm is twice as large and has the same shape"),
    q1=same("the first joint turns the arm about the base"),
)  # fmt: skip
def distance(link=1.0, q1=0.5):
    """Return how far from its base the arm ends."""
    return np.linalg.norm(LAB.reach(q1, 1.0, link, link / 2))

"""Day 11: what is said of an answer that no named mistake gives is true of it."""

import inprocess
import numpy as np
import pytest

from labkit.lesson.day import find_day
from robo47 import distance

pytestmark = pytest.mark.kit


def shorter_inside(p, half):
    """Return a depth that is 0.9 times what it is to be."""
    right = distance.box_sdf(p, half)
    return 0.9 * right if right < 0 else right


def wide_cube(a0, a1, r):
    """Return a box whose half sides are 0.7 times the longest one, and r."""
    middle = (a0 + a1) / 2
    half = 0.7 * np.abs(a1 - a0).max() + r
    return np.array([middle - half, middle + half])


def careless(s, gap, dq, reach):
    """Count the third joint half."""
    counted = np.where(np.arange(7) == 2, 0.5, 1.0)
    return distance.conservative_advance(s, gap, dq * counted, reach)


def scaled(qd, slope, gap, gain):
    """Change 0.7 times as much as is needed."""
    return qd + 0.7 * (distance.velocity_damper(qd, slope, gap, gain) - qd)


def two_terms(J, p, o, link):
    """Return n . v and three times n . (omega x p), of all joints."""
    n = (p - o) / np.linalg.norm(p - o)
    return n @ J[3:] + 3 * (np.cross(J[:3].T, p) @ n)


CASES = {
    "box_sdf": (shorter_inside, "wrong-inside", "wrong inside"),
    "capsule_aabb": (wide_cube, "other-sides", "0.7 times the longest of |a1 - a0|"),
    "conservative_advance": (careless, "wrong-on-the-way", "counts joint 3 0.5 times"),
    "velocity_damper": (scaled, "wrong-where-too-fast", "0.7 times as large as"),
    "distance_gradient": (two_terms, "other-terms", "3 n . (omega x p), for all"),
}


@pytest.mark.parametrize("function", CASES)
def test_a_mistake_without_a_name_is_told_where_it_shows(function):
    code, slug, says = CASES[function]
    day = find_day(11)
    task = next(task.id for task in day.tasks if function in task.functions)
    found = inprocess.verdicts(day, day.source, task, instead={function: code})[task]
    assert found.mistake == slug, found.message
    assert says in found.message

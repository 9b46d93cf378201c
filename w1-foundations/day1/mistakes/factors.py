"""Mistakes in task 1.5: `link_T(pos, quat)` and `joint_T(q)`, one factor each.

A mistake in `make_T`, `Rz` or `quat_to_R` is one in what is built from it, so those of
tasks 1.1 to 1.4 are lifted here. `redo` of the lifted ones is the whole function.
"""

import numpy as np

from labkit.judge.finished import of_a_pose
from labkit.judge.matrices import pose
from labkit.judge.mistake import Mistake, applied, lifted
from robo47 import se3
from robo47.checks import Array

from .poses import MAKE_T
from .rotations import QUAT_TO_R, RZ


def link(pos: Array, quat: Array) -> Array:
    """Return the pose of a body on its parent, (..., 4, 4), from pos and quat."""
    return pose(se3.quat_to_R(quat), pos)


def turn(q: Array) -> Array:
    """Return what a Panda joint at q, (...), adds: a turn about z, (..., 4, 4)."""
    return pose(se3.Rz(q), np.zeros(3))


LINK_T = [
    Mistake(
        "pos-divided",
        "the rotation is right, but pos is divided by 1000; the file is in metres",
        lambda pos, quat: pose(se3.quat_to_R(quat), pos / 1000.0),
        "the right one with pos / 1000",
    ),
    *lifted(MAKE_T, "", lambda redo: lambda pos, quat: redo(se3.quat_to_R(quat), pos)),
    *lifted(QUAT_TO_R, "", lambda redo: lambda pos, quat: pose(redo(quat), pos)),
]

# A joint does not move its body, so these change nothing.
_NO_MOVE = ("t-in-last-row", "t-lost", "t-negated", "millimetres")

JOINT_T = [
    Mistake(
        "slides-along-z",
        "the joint moves along z by q metres; the Panda's joints turn about z",
        lambda q: pose(np.eye(3), q[..., None] * [0.0, 0.0, 1.0]),
        "a slide by q",
    ),
    *lifted(RZ, "", lambda redo: lambda q: pose(redo(q), np.zeros(3))),
    *applied(
        (m for m in of_a_pose("maps the parent to the body") if m.slug not in _NO_MOVE),
        turn,
    ),
]

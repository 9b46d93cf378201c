"""Mistakes in task 7.3 `joint_move(q0, q1, t, T)`, (n, 7) or (n,) to (n, 3, 7)."""

from collections.abc import Callable

import numpy as np

from robo47 import trajectory
from robo47.checks import Array
from robo47.diagnose.mistake import Mistake, lifted

from .scalings import SCALING

Scaling = Callable[[Array, Array], Array]


def move(scaling: Scaling) -> Callable[..., Array]:
    """Return `joint_move`, made with a scaling."""

    def redo(q0: Array, q1: Array, t: Array, T: Array) -> Array:
        rows = scaling(t, T)[:, :, None] * (q1 - q0)[:, None, :]
        rows[:, 0] += q0
        return rows

    return redo


def _way(factor: Callable[[Array, Array], Array]) -> Callable[..., Array]:
    def redo(q0: Array, q1: Array, t: Array, T: Array) -> Array:
        rows = trajectory.quintic_scaling(t, T)[:, :, None] * factor(q0, q1)[:, None, :]
        rows[:, 0] += q0
        return rows

    return redo


def _without_start(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    return trajectory.joint_move(0.0 * q0, q1 - q0, t, T)


def _start_everywhere(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    return _without_start(q0, q1, t, T) + q0[:, None, :]


JOINT_MOVE = [
    Mistake(
        "start-everywhere",
        "q0 is added to the speed and the acceleration too; it does not move",
        _start_everywhere,
        "the answer with q0 in every row",
    ),
    Mistake(
        "start-forgotten",
        "the way is there, but not where it starts: q0 is missing",
        _without_start,
        "the answer without q0",
    ),
    Mistake(
        "goal-for-way",
        "q1 stands where the way from q0 to q1 belongs: it ends at q0 + q1",
        _way(lambda q0, q1: q1),
        "the answer with q1 for the way",
    ),
    Mistake(
        "way-reversed",
        "the way points from q1 to q0: it moves away from the goal",
        _way(lambda q0, q1: q0 - q1),
        "the answer with the way reversed",
    ),
    Mistake(
        "backwards",
        "it goes from q1 to q0",
        lambda q0, q1, t, T: trajectory.joint_move(q1, q0, t, T),
        "the move the other way",
    ),
    Mistake(
        "speed-forwards-only",
        "the way has lost its sign: every joint goes forwards",
        _way(lambda q0, q1: np.abs(q1 - q0)),
        "the answer with |q1 - q0|",
    ),
    *lifted(SCALING, "in the scaling, ", move),
]

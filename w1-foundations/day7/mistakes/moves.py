"""Mistakes in task 7.3 `joint_move(q0, q1, t, T)`, (n, 7) or (n,) to (n, 3, 7)."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake, lifted
from robo47 import trajectory
from robo47.checks import Array

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


def _rates(factor: Callable[[Array, Array], Array]) -> Callable[..., Array]:
    """Return `joint_move` with another way in qd and qdd alone."""

    def redo(q0: Array, q1: Array, t: Array, T: Array) -> Array:
        rows = trajectory.joint_move(q0, q1, t, T)
        rates = trajectory.quintic_scaling(t, T)[:, 1:, None]
        rows[:, 1:] = rates * factor(q0, q1)[:, None, :]
        return rows

    return redo


def _divided_again(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    rows = trajectory.joint_move(q0, q1, t, T)
    rows[:, 1:] /= np.stack([T, T**2], axis=-1)[:, :, None]
    return rows


def _wrapped(angles: Array) -> Array:
    return np.mod(angles + np.pi, 2 * np.pi) - np.pi


def _q_wrapped(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    rows = trajectory.joint_move(q0, q1, t, T)
    rows[:, 0] = _wrapped(rows[:, 0])
    return rows


def _without_start(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    return trajectory.joint_move(0.0 * q0, q1 - q0, t, T)


def _start_everywhere(q0: Array, q1: Array, t: Array, T: Array) -> Array:
    return _without_start(q0, q1, t, T) + q0[:, None, :]


JOINT_MOVE = [
    Mistake(
        "start-everywhere",
        "the start q0 is added to the speed and the acceleration too; it does not move",
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
        "the goal q1 stands where the way from q0 to q1 belongs: it ends at q0 + q1",
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
    Mistake(
        "rates-without-way",
        "the speed and the acceleration are those of s; each joint's way is missing",
        _rates(lambda q0, q1: np.ones_like(q1)),
        "the answer with sd and sdd for every joint",
    ),
    Mistake(
        "rates-of-the-goal",
        "in the speed and the acceleration, q1 stands where the way q1 - q0 belongs",
        _rates(lambda q0, q1: q1),
        "the answer with q1 sd and q1 sdd",
    ),
    Mistake(
        "rates-divided-again",
        "the speed and the acceleration are divided by T again; sd and sdd are "
        "derivatives with respect to t already",
        _divided_again,
        "the answer with sd / T and sdd / T^2",
    ),
    Mistake(
        "q-wrapped",
        "the angles are wrapped into +-pi; a joint's angle is no direction, and joint6 "
        "goes up to 3.75 rad",
        _q_wrapped,
        "the answer with q wrapped",
    ),
    Mistake(
        "way-wrapped",
        "the way is wrapped into +-pi, the shorter way round; a joint cannot go "
        "through its ends",
        lambda q0, q1, t, T: trajectory.joint_move(q0, q0 + _wrapped(q1 - q0), t, T),
        "the answer with the way wrapped",
    ),
    *lifted(SCALING, "in the scaling, ", move),
]

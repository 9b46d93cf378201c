"""Mistakes in task 7.5 `quintic_coefficients(start, end, T)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.ask import Case
from labkit.judge.mistake import Finding, Mistake, each
from robo47 import trajectory
from robo47.checks import Array

POWERS = np.arange(6)
CONDITIONS = tuple(
    f"the {what} at the {where}"
    for where in ("start", "end")
    for what in ("position", "speed", "acceleration")
)


def _conditions(T: float) -> Array:
    A = np.zeros((6, 6))
    A[0, 0], A[1, 1], A[2, 2] = 1.0, 1.0, 2.0
    A[3] = T**POWERS
    A[4] = POWERS * T ** np.maximum(POWERS - 1, 0)
    A[5] = POWERS * (POWERS - 1) * T ** np.maximum(POWERS - 2, 0)
    return A


def _solved(change: Callable[[Array, float], Array]) -> Callable[..., Array]:
    def one(start: Array, end: Array, T: float) -> Array:
        A = change(_conditions(T), T)
        return np.linalg.solve(A, np.concatenate([start, end]))

    return each(one)


def _two_forgotten(A: Array, T: float) -> Array:
    A[2, 2] = 1.0
    return A


def _cubic(start: Array, end: Array, T: float) -> Array:
    A = _conditions(T)[[0, 1, 3, 4], :4]
    four = np.linalg.solve(A, [start[0], start[1], end[0], end[1]])
    return np.append(four, [0.0, 0.0])


def _interleaved(start: Array, end: Array, T: Array) -> Array:
    six = np.stack([start, end], axis=-1).reshape(len(T), 6)
    return trajectory.quintic_coefficients(six[:, :3], six[:, 3:], T)


def which_condition(case: Case) -> Finding | None:
    """Return which one of the six conditions an answer does not keep, if it is one."""
    start, end, T = case.arguments
    rows = np.array([_conditions(float(x)) for x in T])
    kept = (rows @ case.S[..., None])[..., 0]
    off = np.abs(kept - np.concatenate([start, end], axis=1)).max(axis=0) > 1e-6
    if off.sum() != 1:
        return None
    which = CONDITIONS[int(np.argmax(off))]
    return Finding(
        "one-condition-not-kept",
        f"Five of the six conditions are kept; {which} is not. What stands in front of "
        "each coefficient there, and what on the right side?",
    )


right = trajectory.quintic_coefficients
COEFFICIENTS = [
    Mistake(
        "descending",
        "the highest power comes first; the constant has to",
        lambda start, end, T: right(start, end, T)[:, ::-1],
        "the answer with the coefficients in descending order",
    ),
    Mistake(
        "ends-swapped",
        "it goes from the end to the start",
        lambda start, end, T: right(end, start, T),
        "the answer with the ends swapped",
    ),
    Mistake(
        "in-powers-of-x",
        "these are the coefficients of powers of t / T, not of t",
        lambda start, end, T: right(start, end, T) * T[:, None] ** POWERS,
        "the answer with the coefficients of t / T",
    ),
    Mistake(
        "T-is-1",
        "T does not count: the end's conditions are those at t = 1",
        lambda start, end, T: right(start, end, np.ones_like(T)),
        "the answer with the coefficients for T = 1",
    ),
    Mistake(
        "cubic",
        "this is a cubic: both accelerations are left out",
        each(_cubic),
        "the cubic",
    ),
    Mistake(
        "accelerations-zero",
        "the accelerations at the ends are taken as 0; they are given",
        lambda start, end, T: right(start * [1, 1, 0], end * [1, 1, 0], T),
        "the answer without accelerations",
    ),
    Mistake(
        "rest-to-rest",
        "speeds and accelerations at the ends are taken as 0; they are given",
        lambda start, end, T: right(start * [1, 0, 0], end * [1, 0, 0], T),
        "the answer with the coefficients from rest to rest",
    ),
    Mistake(
        "two-forgotten",
        "the second derivative of t^2 is 2, not 1: the start's acceleration is doubled",
        _solved(_two_forgotten),
        "the answer with a 1 there",
    ),
    Mistake(
        "conditions-mixed-up",
        "the right side alternates start and end, but the rows do not",
        _interleaved,
        "the answer with the right side mixed",
    ),
]

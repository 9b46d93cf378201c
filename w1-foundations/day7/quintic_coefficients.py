"""7.5 `quintic_coefficients(start, end, duration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Slip, Vector
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.trajectory import quintic_coefficients

POWERS = np.arange(6)
FACTORS = tuple(f"the factor of {p}" for p in ("1", "t", "t^2", "t^3", "t^4", "t^5"))
CONDITIONS = tuple(
    f"the {what} at the {where}"
    for where in ("start", "end")
    for what in ("position", "speed", "acceleration")
)
SINGULAR = Slip(
    "LinAlgError: Singular",
    "",
    "singular",
    "Two of the six rows say the same, so the equations have no single answer. Each "
    "row is another condition: a position, a speed or an acceleration, at "
    "either end. What is the derivative of t^n?",
)


def conditions(T):
    """Return the six conditions' factors of the coefficients, one row each."""
    A = np.zeros((6, 6))
    A[0, 0], A[1, 1], A[2, 2] = 1.0, 1.0, 2.0
    A[3] = T**POWERS
    A[4] = POWERS * T ** np.maximum(POWERS - 1, 0)
    A[5] = POWERS * (POWERS - 1) * T ** np.maximum(POWERS - 2, 0)
    return A


def which_condition(case: Case) -> Finding | None:
    """Return which one of the six conditions an answer does not keep, if it is one."""
    start, end, T = case.arguments
    rows = np.array([conditions(float(x)) for x in T])
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


row = Row(
    Vector((6,), names=FACTORS, scale=10.0), slips=[SINGULAR], unnamed=which_condition
)


@row.inputs
def _(rng):
    zero = np.zeros(3)
    one = np.array([1.0, 0.0, 0.0])
    yield zero, one, 1.0
    yield zero, one, 2.0
    yield np.array([0.02, -0.1, 0.3]), np.array([0.05, 0.1, -0.4]), 0.25
    start, end = rng.numbers(-1, 1, 2, 8, 3)
    T = rng.numbers(0.5, 2.5, 8)
    yield from zip(start, end, T.tolist(), strict=True)


@row.wrongs
def _(start, end, T):
    """descending: the highest power comes first; the constant has to
    ends-swapped: it goes from the end to the start => the answer with the ends swapped
    in-powers-of-x: these are the coefficients of powers of t / duration, not of t
    T-is-1: the duration does not count: the end's conditions are those at t = 1 => the
      answer with the coefficients for 1 s
    cubic: this is a cubic: both accelerations are left out => the cubic
    accelerations-zero: the accelerations at the ends are taken as 0; they are given
    rest-to-rest: speeds and accelerations at the ends are taken as 0; they are given
    two-forgotten: the second derivative of t^2 is 2, not 1: the start's acceleration is
      doubled => the answer with a 1 there
    conditions-mixed-up: the right side alternates start and end, but the rows do not
    """
    A = conditions(T)
    four = np.linalg.solve(A[[0, 1, 3, 4], :4], [*start[:2], *end[:2]])
    mixed = np.stack([start, end], axis=1).ravel()
    slow, still = np.diag([1.0, 1.0, 0.0]), np.diag([1.0, 0.0, 0.0])
    return {
        "descending": quintic_coefficients(start, end, T)[::-1],
        "ends-swapped": quintic_coefficients(end, start, T),
        "in-powers-of-x": quintic_coefficients(start, end, T) * T**POWERS,
        "T-is-1": quintic_coefficients(start, end, 1.0),
        "cubic": np.append(four, [0.0, 0.0]),
        "accelerations-zero": quintic_coefficients(slow @ start, slow @ end, T),
        "rest-to-rest": quintic_coefficients(still @ start, still @ end, T),
        "two-forgotten": quintic_coefficients(start * [1.0, 1.0, 2.0], end, T),
        "conditions-mixed-up": np.linalg.solve(A, mixed),
    }


@row.right  # The closed form from another book.
def _(start, end, T):
    (q0, v0, a0), (q1, v1, a1) = start, end
    h = q1 - q0
    three = (20 * h - (8 * v1 + 12 * v0) * T - (3 * a0 - a1) * T**2) / (2 * T**3)
    four = (-30 * h + (14 * v1 + 16 * v0) * T + (3 * a0 - 2 * a1) * T**2) / (2 * T**4)
    five = (12 * h - 6 * (v1 + v0) * T + (a1 - a0) * T**2) / (2 * T**5)
    return np.array([q0, v0, a0 / 2, three, four, five])


row.at_least_0(duration="how long the move takes")

"""7.5 `quintic_coefficients(start, end, duration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Slip, Vector
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.trajectory import quintic_coefficients

POWERS = np.arange(6)
FACTORS = tuple(
    f"the coefficient of {p}" for p in ("1", "t", "t^2", "t^3", "t^4", "t^5")
)
CONDITIONS = tuple(
    f"the {what} at the {where}"
    for where in ("start", "end")
    for what in ("position", "velocity", "acceleration")
)
SINGULAR = Slip(
    "LinAlgError: Singular",
    "",
    "singular",
    "Your matrix is singular, because its rows are linearly dependent. The six rows "
    "should express the position, the velocity and the acceleration at both ends. What "
    "is the derivative of t^n?",
)


def conditions(T):
    """Return the matrix of the six conditions, one row each."""
    A = np.zeros((6, 6))
    A[0, 0], A[1, 1], A[2, 2] = 1.0, 1.0, 2.0
    A[3] = T**POWERS
    A[4] = POWERS * T ** np.maximum(POWERS - 1, 0)
    A[5] = POWERS * (POWERS - 1) * T ** np.maximum(POWERS - 2, 0)
    return A


def which_condition(case: Case) -> Finding | None:
    """Return which of the six conditions an answer violates, if it is only one."""
    start, end, T = case.arguments
    rows = np.array([conditions(float(x)) for x in T])
    kept = (rows @ case.S[..., None])[..., 0]
    off = np.abs(kept - np.concatenate([start, end], axis=1)).max(axis=0) > 1e-6
    if off.sum() != 1:
        return None
    which = CONDITIONS[int(np.argmax(off))]
    return Finding(
        "one-condition-not-kept",
        "Your polynomial satisfies five of the six conditions, but not the condition "
        f"for {which}. Check this condition. In a linear system, it is one row of the "
        "matrix and one entry of the right-hand side.",
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
    """in-powers-of-x: your code returns the coefficients of the powers of t / duration.
      Return the coefficients of the powers of t instead
    T-is-1: your result is the polynomial for a duration of 1 s, so the duration has no
      effect. The conditions at the end hold at t = duration
    cubic: your polynomial is a cubic, which does not satisfy the two conditions for the
      accelerations. Use a polynomial of degree 5 instead, because it has six
      coefficients for the six conditions
    accelerations-zero: your polynomial has an acceleration of 0 at both ends. Use the
      accelerations in `start` and `end` instead
    rest-to-rest: your polynomial has a velocity and an acceleration of 0 at both ends.
      Use the values in `start` and `end` instead
    two-forgotten: your coefficient of t^2 is the initial acceleration. It should be
      half of it, because the second derivative of t^2 is 2
    conditions-mixed-up: your polynomial has the six values of `start` and `end` in the
      wrong places, because `start` and `end` alternate. The three values of `start`
      belong to t = 0, and the three values of `end` belong to t = duration
    """
    A = conditions(T)
    four = np.linalg.solve(A[[0, 1, 3, 4], :4], [*start[:2], *end[:2]])
    mixed = np.stack([start, end], axis=1).ravel()
    slow, still = np.diag([1.0, 1.0, 0.0]), np.diag([1.0, 0.0, 0.0])
    return {
        "in-powers-of-x": quintic_coefficients(start, end, T) * T**POWERS,
        "T-is-1": quintic_coefficients(start, end, 1.0),
        "cubic": np.append(four, [0.0, 0.0]),
        "accelerations-zero": quintic_coefficients(slow @ start, slow @ end, T),
        "rest-to-rest": quintic_coefficients(still @ start, still @ end, T),
        "two-forgotten": quintic_coefficients(start * [1.0, 1.0, 2.0], end, T),
        "conditions-mixed-up": np.linalg.solve(A, mixed),
    }


@row.right  # The first three, then what the end still needs.
def _(start, end, T):
    two = start[2] / 2  # the coefficient of t^2
    dp = end[0] - start[0] - start[1] * T - two * T**2  # the rest of the position
    dv = (end[1] - start[1] - 2 * two * T) * T  # the rest of the velocity, times T
    da = (end[2] - 2 * two) * T**2  # the rest of the acceleration, times T^2
    three = (10 * dp - 4 * dv + da / 2) / T**3  # the coefficient of t^3
    four = (-15 * dp + 7 * dv - da) / T**4  # the coefficient of t^4
    five = (6 * dp - 3 * dv + da / 2) / T**5  # the coefficient of t^5
    return np.array([start[0], start[1], two, three, four, five])


@row.right  # The closed form from another book.
def _(start, end, T):
    (q0, v0, a0), (q1, v1, a1) = start, end
    h = q1 - q0
    three = (20 * h - (8 * v1 + 12 * v0) * T - (3 * a0 - a1) * T**2) / (2 * T**3)
    four = (-30 * h + (14 * v1 + 16 * v0) * T + (3 * a0 - 2 * a1) * T**2) / (2 * T**4)
    five = (12 * h - 6 * (v1 + v0) * T + (a1 - a0) * T**2) / (2 * T**5)
    return np.array([q0, v0, a0 / 2, three, four, five])


row.at_least_0(duration="a duration is not negative")

"""Rotations at which a logarithm often fails, for task 7.6: by pi, and by little.

They are tested only if the function is right for drawn rotations, so that another
mistake is reported first.
"""

import numpy as np

from labkit.judge import Draw, HeldOut
from robo47 import screws, se3
from robo47.checks import Array

# At exactly pi both senses are correct, so s is 1 there: both end at R1.
HALF = ([1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 2.0, -2.0])
NEARLY_HALF = np.pi - 1e-3
TINY = 5e-7  # radians
SMALL = (5e-5, 2e-4, 3e-3, 0.03)  # radians


def _ends(R0: Array, turns: Array, s: float, rng: Draw) -> list:
    """Return two poses and s for each rotation, which starts at R0."""
    p0, p1 = rng.numbers(-1, 1, 2, len(turns), 3)
    T0 = se3.make_T(R0, p0)
    T1 = se3.make_T(R0 @ turns, p1)
    return [(a, b, s) for a, b in zip(T0, T1, strict=True)]


def _half(rng: Draw) -> list:
    n = np.array(HALF)
    unit = n / np.linalg.norm(n, axis=1, keepdims=True)
    turns = 2 * unit[:, :, None] * unit[:, None, :] - np.eye(3)  # exactly symmetric
    own = np.tile(np.eye(3), (len(n), 1, 1))
    drawn = rng.rotations(len(n))
    return [*_ends(own, turns, 1.0, rng), *_ends(drawn, turns, 1.0, rng)]


def _half_or_nearly(rng: Draw) -> list:
    turns = screws.axis_angle(rng.units(4), NEARLY_HALF)
    return [*_half(rng), *_ends(rng.rotations(4), turns, 0.5, rng)]


def _small(rng: Draw, angles: tuple[float, ...] = SMALL) -> list:
    turns = screws.axis_angle(rng.units(len(angles)), np.array(angles))
    return _ends(rng.rotations(len(angles)), turns, 0.7, rng)


def _not_turned(T0: Array, T1: Array, s: float) -> Array:
    return se3.make_T(T0[:3, :3], T0[:3, 3] + s * (T1[:3, 3] - T0[:3, 3]))


TURNS = [
    HeldOut(
        "half-turn-for-none",
        "Your function is correct except for a rotation by 180 degrees, where the "
        "orientation at s = 1 is still R0. The sine is 0 at both 0 and 180 "
        "degrees. Which quantity distinguishes these two angles?",
        _half,
        mistaken=_not_turned,
    ),
    HeldOut(
        "wrong-at-pi",
        "Your function is correct except for some rotations by 180 degrees or slightly "
        "less. For such a rotation R = R0^T R1, the matrix R - R^T is nearly 0 and "
        "does not determine the axis, but R + R^T determines the axis up to its sign.",
        _half_or_nearly,
    ),
    HeldOut(
        "small-turn-for-none",
        "Your function is correct except for very small rotations, where the "
        "orientation remains R0. Either your function skips the rotation below some "
        "angle, or rounding makes the angle 0.",
        lambda rng: _small(rng, (TINY,)),
        mistaken=_not_turned,
        near=1e-9,
    ),
    HeldOut(
        "wrong-near-0",
        "Your function is correct except for some rotations by 2 degrees or less. "
        "Either a special case for small angles is wrong, or the angle has a rounding "
        "error, for example because arccos is inaccurate near 1.",
        _small,
    ),
]

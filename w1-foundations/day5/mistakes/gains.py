"""Mistakes in task 5.2 `gains`: two numbers from two numbers."""

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array


def _two(first: Array, second: Array) -> Array:
    return np.stack(np.broadcast_arrays(first, second), axis=-1)


GAINS = [
    Mistake(
        "two-forgotten",
        "kd is zeta omega; the standard form has a factor of its own before them, "
        "and without it the joint is damped half as much as you asked",
        lambda w, z: _two(w**2, z * w),
    ),
    Mistake(
        "kp-is-omega",
        "kp is omega, not its square: compare the units, kp is in 1/s2",
        lambda w, z: _two(w, 2 * z * w),
    ),
    Mistake(
        "kd-is-omega",
        "kd is omega whatever zeta is, which is right for zeta = 0.5 alone. It tracks "
        "well and overshoots by a sixth",
        lambda w, z: _two(w**2, w),
    ),
    Mistake(
        "zeta-ignored",
        "kd does not depend on zeta: it is right for critical damping alone",
        lambda w, z: _two(w**2, 2 * w),
    ),
    Mistake("swapped", "kp and kd are swapped", lambda w, z: _two(2 * z * w, w**2)),
    Mistake(
        "root-of-omega",
        "kd has the square root of omega in it, as if omega were kp already",
        lambda w, z: _two(w**2, 2 * z * np.sqrt(w)),
    ),
    Mistake(
        "kd-with-omega-squared",
        "kd has omega squared in it: compare the units, kd is in 1/s",
        lambda w, z: _two(w**2, 2 * z * w**2),
    ),
    Mistake(
        "zeta-squared-in-kp",
        "kp has zeta in it; damping changes kd alone",
        lambda w, z: _two((z * w) ** 2, 2 * z * w),
    ),
    Mistake(
        "omega-in-turns",
        "omega is taken for turns per second and multiplied by 2 pi; it comes in rad/s",
        lambda w, z: _two((2 * np.pi * w) ** 2, 4 * np.pi * z * w),
    ),
]

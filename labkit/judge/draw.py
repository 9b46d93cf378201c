"""Inputs for a day's questions, drawn from a seeded generator.

All are rounded, so that a message can show an input and a student can type it.
"""

from functools import cache

import numpy as np

from robo47 import panda, se3, verify
from robo47.checks import Array

DECIMALS = 3
READY = panda.READY_Q
ZERO = np.zeros(7)


def rounded(values: Array) -> Array:
    """Return numbers with as many decimals as a person would type."""
    return np.round(values, DECIMALS) + 0.0


def numbers(rng: np.random.Generator, low: float, high: float, *shape: int) -> Array:
    """Return uniform numbers, (*shape,), rounded."""
    return rounded(rng.uniform(low, high, shape))


def units(rng: np.random.Generator, n: int) -> Array:
    """Return unit vectors, (n, 3), not rounded: they would not be unit then."""
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def rotations(rng: np.random.Generator, n: int) -> Array:
    """Return random rotations, (n, 3, 3)."""
    return se3.quat_to_R(rng.normal(size=(n, 4)))


def poses(rng: np.random.Generator, n: int, reach: float = 1.0) -> Array:
    """Return random poses, (n, 4, 4), each axis up to `reach` metres away."""
    return se3.make_T(rotations(rng, n), numbers(rng, -reach, reach, n, 3))


def configurations(rng: np.random.Generator, n: int) -> Array:
    """Return joint angles of the Panda within its limits, (n, 7)."""
    seed = int(rng.integers(2**31))
    return rounded(verify.random_q(_arm(), n, seed))


@cache
def _arm():
    return panda.load("panda_nohand")

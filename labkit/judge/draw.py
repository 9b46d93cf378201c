"""Inputs for a day's questions, drawn from a seeded generator.

All are rounded, so that a message can show an input and a student can type it. `Edges`
is a generator of the values at which a function's branches part.
"""

from functools import cache

import numpy as np

from robo47 import panda, se3, verify
from robo47.checks import Array

DECIMALS = 3
READY = panda.READY_Q
ZERO = np.zeros(7)


class Edges(np.random.Generator):
    """A generator that draws the ends of each range, its middle, and whole axes."""

    def uniform(self, low=0.0, high=1.0, size=None):
        """Return for each number one of the ends or the middle of its range."""
        part = self.choice([0.0, 0.5, 1.0], size)
        return low + (np.asarray(high) - low) * part

    def normal(self, loc=0.0, scale=1.0, size=None):
        """Return rows of 0, 1 and -1, none of zeros alone."""
        found = np.atleast_1d(self.choice([0.0, 1.0, -1.0], size))
        found[..., 0] += ~found.any(axis=-1)
        return loc + scale * found


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
    if isinstance(rng, Edges):
        low, high = _arm().jnt_range[:7].T
        return rounded(rng.uniform(low, high, (n, 7)))
    seed = int(rng.integers(2**31))
    return rounded(verify.random_q(_arm(), n, seed))


@cache
def _arm():
    return panda.load("panda_nohand")

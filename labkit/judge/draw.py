"""Inputs of questions: drawn numbers that a person can type, and their edges."""

from collections.abc import Sequence
from functools import cache
from typing import Any

import mujoco
import numpy as np

from robo47 import panda, se3, verify
from robo47.checks import Array

DECIMALS = 3


def rounded(values: Array) -> Array:
    """Return numbers with as many decimals as a person would type."""
    return np.round(values, DECIMALS) + 0.0


@cache
def _arm() -> mujoco.MjModel:
    return panda.load("panda_nohand")


class Draw(np.random.Generator):
    """A seeded generator of inputs, rounded: a student can read and type them."""

    def __init__(self, seed: int | Sequence[int]) -> None:
        """Take the seed; the numbers are those of `np.random.default_rng(seed)`."""
        super().__init__(np.random.PCG64(seed))

    def numbers(self, low: float, high: float, *shape: Any) -> Array:
        """Return uniform numbers, (*shape,), which may be given as one tuple, too."""
        if len(shape) == 1 and isinstance(shape[0], tuple):
            (shape,) = shape
        return rounded(self.uniform(low, high, shape))

    def units(self, n: int) -> Array:
        """Return unit vectors, (n, 3), not rounded: they would not be unit then."""
        v = self.normal(size=(n, 3))
        return v / np.linalg.norm(v, axis=1, keepdims=True)

    def rotations(self, n: int) -> Array:
        """Return random rotations, (n, 3, 3), not rounded."""
        return se3.quat_to_R(self.normal(size=(n, 4)))

    def poses(self, n: int, reach: float = 1.0) -> Array:
        """Return random poses, (n, 4, 4), each axis up to `reach` metres away."""
        return se3.make_T(self.rotations(n), self.numbers(-reach, reach, n, 3))

    def configurations(self, n: int) -> Array:
        """Return joint angles of the Panda within its limits, (n, 7)."""
        return rounded(verify.random_q(_arm(), n, int(self.integers(2**31))))


class Edges(Draw):
    """Values at which a function's branches part: ends, middles, whole axes."""

    _choosing = False

    def uniform(self, low=0.0, high=1.0, size=None):
        """Return for each number one of the ends or the middle of its range."""
        part = self.choice([0.0, 0.5, 1.0], size)
        return low + (np.asarray(high) - low) * part

    def normal(self, loc=0.0, scale=1.0, size=None):
        """Return rows of 0, 1 and -1, none of zeros alone."""
        found = np.atleast_1d(self.choice([0.0, 1.0, -1.0], size))
        found[..., 0] += ~found.any(axis=-1)
        return loc + scale * found

    def choice(self, *args, **more):  # type: ignore[override]
        """Return what is drawn from a list; that asks for whole numbers of its own."""
        self._choosing = True
        found = super().choice(*args, **more)
        self._choosing = False
        return found

    def integers(self, low, high=None, size=None, **more):  # type: ignore[override]
        """Return for each whole number the first, the last or the one between."""
        if self._choosing:
            return super().integers(low, high, size, **more)
        low, high = (0, low) if high is None else (low, high)
        last = np.asarray(high) - (not more.get("endpoint"))
        part = self.choice([0, 1, 2], size)
        return low + (last - low) * part // 2

    def configurations(self, n: int) -> Array:
        """Return joint angles at the ends and middles of their ranges, (n, 7)."""
        low, high = _arm().jnt_range[:7].T
        return rounded(self.uniform(low, high, (n, 7)))

"""Day 3's own kinds of answers."""

from dataclasses import dataclass

import numpy as np

from labkit.judge import Scalar, Twist, Vector
from labkit.judge.kinds import Kind
from robo47.checks import Array


@dataclass(frozen=True)
class Gap(Twist):
    """A pose error: a rotation above, a translation below."""

    halves = ("the rotation", "the translation")


class _OrNaN(Kind):
    """An answer that may have NaN in it: how far off are the others?"""

    def apart(self, S: Array, T: Array) -> str:
        fine = np.isfinite(S).reshape(len(S), -1).all(axis=1)
        if fine.all() or not fine.any():
            return super().apart(S, T)
        return f"{super().apart(S[fine], T[fine])} where it is a number"


class Numbers(_OrNaN, Vector):
    """A vector, or NaN."""


class Number(_OrNaN, Scalar):
    """A number, or NaN."""

"""Inputs that several toy rows share."""

import numpy as np


def pairs(rng):
    """Yield two vectors."""
    yield np.array([1.0, 0.0, 0.0]), np.array([0.0, 2.0, 0.0])
    yield from zip(*rng.numbers(-1, 1, 2, 5, 3), strict=True)


def vectors(rng, n=3):
    """Yield one vector."""
    yield from ((v,) for v in rng.numbers(-1, 1, 6, n))


def skew(w):
    """Return [w], (3, 3)."""
    x, y, z = w
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])

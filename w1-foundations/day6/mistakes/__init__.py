"""Day 6's named mistakes, each made again on purpose, one case at a time."""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.mistake import Mistake, each
from robo47.checks import Array


def named(slug: str, says: str, redo: Callable[..., Any], redone: str) -> Mistake:
    """Return a mistake from a function of one case."""
    return Mistake(slug, says, each(redo), redone)


def root(A: Array) -> Array:
    """Return the square root of a symmetric matrix."""
    values, vectors = np.linalg.eigh(A)
    return (vectors * np.sqrt(values)) @ vectors.T

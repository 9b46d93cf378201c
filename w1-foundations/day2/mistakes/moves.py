"""Day 2's formulas without checks, with parts that can be replaced by mistakes.

Leading dimensions broadcast. Screws are (omega; v); angles (...), in radians.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import pose, times
from labkit.judge.mistake import Mistake
from robo47.checks import Array

Function = Callable[..., Any]


def skew(w: Array) -> Array:
    """Return [w], (..., 3, 3)."""
    return from_rows(lambda x, y, z: [[0, -z, y], [z, 0, -x], [-y, x, 0]])(w)


def from_rows(rows: Callable[[Array, Array, Array], list]) -> Callable[[Array], Array]:
    """Return a function of (x, y, z) from the rows of its matrix."""

    def matrix(w: Array) -> Array:
        x, y, z = np.moveaxis(np.asarray(w, dtype=np.float64), -1, 0)
        cells = [
            [np.broadcast_to(cell, x.shape) for cell in row] for row in rows(x, y, z)
        ]
        return np.moveaxis(np.array(cells, dtype=np.float64), (0, 1), (-2, -1))

    return matrix


def sine(theta: Array) -> Array:
    """Return the sine: what stands before K."""
    return np.sin(theta)


def versine(theta: Array) -> Array:
    """Return 1 - cos: what stands before K K."""
    return 1.0 - np.cos(theta)


def rest(theta: Array) -> Array:
    """Return theta - sin: what stands before K K in the translation."""
    return theta - np.sin(theta)


def rotation(
    axis: Array,
    theta: Array,
    first: Function = sine,
    second: Function = versine,
    bracket: Function = skew,
    square: Function = np.matmul,
) -> Array:
    """Return I + first(theta) K + second(theta) K K, (..., 3, 3)."""
    K, theta = bracket(axis), np.asarray(theta)[..., None, None]
    return np.eye(3) + first(theta) * K + second(theta) * square(K, K)


def travel(
    S: Array,
    theta: Array,
    zeroth: Function = np.positive,
    first: Function = versine,
    second: Function = rest,
    bracket: Function = skew,
) -> Array:
    """Return (zeroth(theta) I + first(theta) K + second(theta) K K) v, (..., 3)."""
    K, theta = bracket(S[..., :3]), np.asarray(theta)[..., None, None]
    G = zeroth(theta) * np.eye(3) + first(theta) * K + second(theta) * K @ K
    return times(G, S[..., 3:])


def motion(
    S: Array, theta: Array, turn: Function = rotation, go: Function = travel
) -> Array:
    """Return the pose of a turn and a travel, (..., 4, 4)."""
    return pose(turn(S[..., :3], theta), go(S, theta))


def factors(step: Function, *columns: Array) -> list[Array]:
    """Return a chain's factors, (n, 4, 4) each, from columns (n, joints, ...)."""
    return list(np.moveaxis(step(*columns), 1, 0))


def without(mistakes: list[Mistake], *slugs: str) -> list[Mistake]:
    """Return mistakes but those that another one of the larger function covers."""
    return [mistake for mistake in mistakes if mistake.slug not in slugs]

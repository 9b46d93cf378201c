"""Vectors as three components, each a number or an array over many configurations.

A component that is the same everywhere stays one number; a zero costs nothing.
"""

from collections.abc import Sequence

import numpy as np

from robo47.checks import Array

Number = float | Array
Vector = list[Number]
Numbers = Sequence[Number] | Array


def turned(x: Number, y: Number, c: Array, s: Array) -> tuple[Number, Number]:
    """Return the components in their plane after a turn with this cosine and sine."""
    return x * c - y * s, x * s + y * c


def plus(u: Numbers, v: Numbers) -> Vector:
    """Return u + v."""
    return [a + b for a, b in zip(u, v, strict=True)]


def combined(rows: Sequence[Numbers] | Array, v: Numbers) -> Vector:
    """Return the product of a matrix, row by row, and a vector."""
    return [dot(row, v) for row in rows]


def cross(t: Array, f: Vector) -> Vector:
    """Return t x f."""
    return [
        dot((t[(x + 1) % 3], -t[(x + 2) % 3]), (f[(x + 2) % 3], f[(x + 1) % 3]))
        for x in range(3)
    ]


def cross_of(a: Array, b: Array) -> Array:
    """Return a x b, (..., 3), without what np.cross checks."""
    (x, y, z), (u, v, w) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-1)


def times(A: Array, x: Array) -> Array:
    """Return A x, (..., m), of matrices, (..., m, n), and vectors, (..., n)."""
    return (A @ x[..., None])[..., 0]


def dot(weights: Numbers, v: Numbers) -> Number:
    """Return the sum of the products, without those that are zero for sure."""
    total: Number = 0.0
    for a, b in zip(weights, v, strict=True):
        if not (_is_zero(a) or _is_zero(b)):
            total = a * b if _is_zero(total) else total + a * b
    return total


def _is_zero(x: Number) -> bool:
    return not isinstance(x, np.ndarray) and x == 0.0

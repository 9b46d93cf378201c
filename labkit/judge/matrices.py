"""Matrix moves without checks: a mistake made on purpose need not give a pose.

`robo47.se3` refuses what is not rigid. Here every function takes what it gets, with any
leading dimensions.
"""

import numpy as np

from robo47.checks import Array


def pose(R: Array, t: Array) -> Array:
    """Return [[R, t], [0, 1]], (..., 4, 4), of any R, (..., 3, 3), and t, (..., 3)."""
    T = np.zeros((*np.broadcast_shapes(R.shape[:-2], t.shape[:-1]), 4, 4))
    T[..., :3, :3] = R
    T[..., :3, 3] = t
    T[..., 3, 3] = 1.0
    return T


def split(T: Array) -> tuple[Array, Array]:
    """Return R, (..., 3, 3), and t, (..., 3), of T, (..., 4, 4)."""
    return T[..., :3, :3], T[..., :3, 3]


def times(M: Array, v: Array) -> Array:
    """Return M v, (..., 3), for M, (..., 3, 3), and v, (..., 3)."""
    return (M @ v[..., None])[..., 0]


def rigid_inverse(T: Array) -> Array:
    """Return the inverse of T, (..., 4, 4), if it is a pose."""
    R, t = split(T)
    return pose(R.mT, -times(R.mT, t))

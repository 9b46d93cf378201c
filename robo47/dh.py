"""Denavit-Hartenberg parameters, in Craig's convention.

Four parameters define the frame of a link relative to the one before it: Rx(alpha)
Tx(a) Rz(theta) Tz(d). Other books use another order, so a table is only defined
together with its convention. Franka publishes the Panda's table in this one. Radians,
metres.

Sources: Craig, *Introduction to Robotics* (2005), section 3.4; *Modern Robotics*,
Appendix C.
"""

import functools

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array


def dh_link(alpha: ArrayLike, a: ArrayLike, d: ArrayLike, theta: ArrayLike) -> Array:
    """Return one link's pose in Craig's convention: Rx(alpha) Tx(a) Rz(theta) Tz(d).

    Args:
        alpha: twist of the link, radians, (...).
        a: length of the link, metres, (...).
        d: offset along the joint's axis, metres, (...).
        theta: joint angle, radians, (...).

    Returns:
        Pose of this link's frame relative to the one before it, (..., 4, 4) (Craig, eq.
        3.6).

    Raises:
        ValueError: shapes that do not broadcast, or a non-finite number.
    """
    alpha, a, d, theta = (
        checks.array(value, name, ())
        for value, name in ((alpha, "alpha"), (a, "a"), (d, "d"), (theta, "theta"))
    )
    ca = np.cos(alpha)
    sa = np.sin(alpha)
    c = np.cos(theta)
    s = np.sin(theta)
    out = np.zeros((*np.broadcast_shapes(ca.shape, a.shape, d.shape, c.shape), 4, 4))
    out[..., 0, 0] = c
    out[..., 0, 1] = -s
    out[..., 0, 3] = a
    out[..., 1, 0] = s * ca
    out[..., 1, 1] = c * ca
    out[..., 1, 2] = -sa
    out[..., 2, 0] = s * sa
    out[..., 2, 1] = c * sa
    out[..., 2, 2] = ca
    out[..., 1, 3] = -d * sa
    out[..., 2, 3] = d * ca
    out[..., 3, 3] = 1.0
    return out


def dh_fk(table: ArrayLike, q: ArrayLike) -> Array:
    """Return the flange's pose from a table of DH parameters in Craig's convention.

    Args:
        table: rows (alpha, a, d), radians and metres, (n + 1, 3): one row for each
            joint, whose theta is its q, and the flange's row, whose theta is 0.
        q: joint angles in radians, (..., n).

    Returns:
        T_world_flange, (..., 4, 4).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    table = checks.array(table, "table", ())
    q = checks.array(q, "q", ())
    if q.ndim == 0 or table.shape != (q.shape[-1] + 1, 3):
        raise ValueError(
            f"table has shape {table.shape} and q {q.shape}; expected (n + 1, 3) and "
            "(..., n): a row (alpha, a, d) for each joint, and the flange's"
        )
    alpha, a, d = table.T
    theta = np.concatenate([q, np.zeros((*q.shape[:-1], 1))], axis=-1)
    links = dh_link(alpha, a, d, theta)
    return functools.reduce(np.matmul, np.moveaxis(links, -3, 0))

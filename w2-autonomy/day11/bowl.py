"""The bowl of |w + s u - t v| squared over s and t, and where it is lowest."""

import numpy as np


def cut(x):
    """Return x clamped to 0..1."""
    return np.clip(x, 0.0, 1.0)


def bowl(a0, a1, b0, b1, w=None):
    """Return u, v and the bowl's a, b, c, d, e."""
    u = a1 - a0
    v = b1 - b0
    w = a0 - b0 if w is None else w
    return u, v, u @ u, u @ v, v @ v, u @ w, v @ w


def lines(a, b, c, d, e):
    """Return s and t of the two lines."""
    across = a * c - b * b
    return (b * e - c * d) / across, (a * e - b * d) / across


def thrice(a, b, c, d, e, s=None):
    """Return s and t: s cut, t for it cut, s for that cut."""
    s = cut(lines(a, b, c, d, e)[0] if s is None else s)
    t = cut((b * s + e) / c)
    return cut((b * t - d) / a), t


def ends_only(a0, a1, b0, b1, way=min):
    """Return the nearest of an end of one and its nearest point on the other."""
    found = []
    for p, x, y, first in (
        (a0, b0, b1, True), (a1, b0, b1, True), (b0, a0, a1, False), (b1, a0, a1, False)
    ):  # fmt: skip
        q = x + cut((p - x) @ (y - x) / ((y - x) @ (y - x))) * (y - x)
        found.append(np.array([p, q] if first else [q, p]))
    return way(found, key=lambda pair: np.linalg.norm(pair[0] - pair[1]))

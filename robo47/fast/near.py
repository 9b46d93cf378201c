"""Distances of segments, points and boxes, for as many pairs as arrays hold.

Leading dimensions broadcast; nothing is checked. What is taught one pair at a time
stands in `robo47.distance`; `robo47.shapes` asks here for a whole arm and many
configurations at once. Metres.
"""

import numpy as np

from robo47.checks import Array

PARALLEL = 1e-12  # sin^2 of the angle below which two segments count as parallel


def closest(a0: Array, a1: Array, b0: Array, b1: Array) -> tuple[Array, Array]:
    """Return the closest points of two segments, (..., 3) each.

    |w + s u - t v|^2 is a convex quadratic over a square of s and t. s of the lines,
    clamped to 0..1; the best t for it, clamped; the best s for that, clamped (Ericson,
    *Real-Time Collision Detection*, section 5.1.9). If the lines are parallel, s is
    free at first.
    """
    u = a1 - a0
    v = b1 - b0
    w = a0 - b0
    a = _dot(u, u)
    b = _dot(u, v)
    c = _dot(v, v)
    d = _dot(u, w)
    e = _dot(v, w)
    den = a * c - b * b  # a c sin^2
    s = _share(b * e - c * d, np.where(den > PARALLEL * a * c, den, 0.0))
    t = _share(b * s + e, c)
    s = _share(b * t - d, a)
    return a0 + s[..., None] * u, b0 + t[..., None] * v


def segment_distances(a0: Array, a1: Array, b0: Array, b1: Array) -> Array:
    """Return the distance of two segments, (...)."""
    p, o = closest(a0, a1, b0, b1)
    return np.sqrt(_dot(p - o, p - o))


def outside(p: Array, half: Array) -> Array:
    """Return how far points, (..., 3), are from boxes about the origin, (...)."""
    beyond = np.abs(p) - half
    out = np.maximum(beyond, 0.0)
    return np.sqrt(_dot(out, out)) + np.minimum(beyond.max(axis=-1), 0.0)


def box_distances(a0: Array, a1: Array, half: Array) -> Array:
    """Return the least `outside` along segments in the box's axes, (...), exactly.

    Its square is made of parabolas that meet where the segment crosses a face's plane:
    between two such places its slope is a straight line. Where it reaches 0 the segment
    goes through the box: then the deepest point is an end, or where two faces are
    equally near.
    """
    u = a1 - a0
    apart = _least_outside(a0, u, half)
    through = apart <= 0.0
    if through.any():
        some = [np.broadcast_to(x, u.shape)[through] for x in (a0, u, half)]
        apart[through] = _deepest(*some)
    return apart


def _least_outside(a0: Array, u: Array, half: Array) -> Array:
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.concatenate([(half - a0) / u, (-half - a0) / u, 0.0 * u[..., :2]], -1)
    s[..., -1] = 1.0
    s = np.fmin(np.fmax(s, 0.0), 1.0)  # 0 / 0, along a face, becomes 0
    s.sort(axis=-1)
    p = a0[..., None, :] + s[..., None] * u[..., None, :]
    out = p - np.minimum(np.maximum(p, -half[..., None, :]), half[..., None, :])
    slope = (out @ u[..., None])[..., 0]  # half of that of the square
    left = s[..., :-1]
    down = slope[..., :-1]
    best = left + (s[..., 1:] - left) * _share(-down, slope[..., 1:] - down)
    p = a0[..., None, :] + best[..., None] * u[..., None, :]
    return np.maximum(outside(p, half[..., None, :]).min(axis=-1), 0.0)


def _deepest(a0: Array, u: Array, half: Array) -> Array:
    """Return the smallest value of the largest of six planes along segments, (m,)."""
    at, way = (np.concatenate([x, -x], axis=-1) for x in (a0, u))
    at = at - np.concatenate([half, half], axis=-1)
    i, j = np.triu_indices(6, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (at[:, j] - at[:, i]) / (way[:, i] - way[:, j])
    s = np.pad(np.nan_to_num(s).clip(0.0, 1.0), ((0, 0), (0, 1)), constant_values=1.0)
    return (at[:, None] + s[..., None] * way[:, None]).max(axis=-1).min(axis=-1)


def _dot(x: Array, y: Array) -> Array:
    return np.einsum("...i,...i->...", x, y)


def _share(over: Array, under: Array) -> Array:
    """Return over / under clamped to 0..1, and 0 where under is 0."""
    found = np.divide(over, under, out=np.zeros_like(over), where=under > 0.0)
    return np.minimum(np.maximum(found, 0.0), 1.0)

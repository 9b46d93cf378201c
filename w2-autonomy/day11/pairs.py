"""What Day 11 asks about: segments of every kind, capsules, boxes, lengths of links."""

import numpy as np

from labkit.judge.answers import once
from robo47 import distance, se3
from robo47.checks import Array

KINDS = ("inside", "an end", "two ends")  # where the closest points of two segments lie
# Parallel, with one closest pair: whole numbers, so that a c - b b is exactly 0.
PARALLEL = [
    ((0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 1, 0)),
    ((0, 0, 0), (2, 0, 0), (5, 0, 0), (3, 0, 0)),
    ((0, 0, 0), (0, -4, 0), (1, 2, 2), (1, 5, 2)),
    ((1, 1, 1), (2, 2, 2), (-1, -1, 1), (-3, -3, -1)),
]
# Nearly: half a degree, and one closest pair all the same.
NEARLY_PARALLEL = [
    ((-1, 0, 0), (1, 0, 0), (-1, -0.005, 1), (1, 0.0125, 1)),
    ((0, -1, 0), (0, 1, 0), (1, 1, -0.0125), (1, -1, 0.004)),
]
# Parallel, side by side: many pairs, one distance.
ALONGSIDE = [
    ((0, 0, 0), (2, 0, 0), (1, 1, 0), (3, 1, 0)),
    ((0, 0, 0), (0, 3, 0), (2, 2, 0), (2, 1, 0)),
]
# Of which one is a point, or both are.
POINTS = [
    ((0, 0, 0), (0, 0, 0), (-1, 1, 0), (2, 1, 0)),
    ((-1, 1, 0), (2, 1, 0), (0, 0, 0), (0, 0, 0)),
    ((0, 3, 4), (0, 3, 4), (0, 0, 0), (0, 0, 0)),
    ((3, 1, 0), (3, 1, 0), (-1, 1, 2), (2, 1, 2)),
]


def arrays(some) -> list[tuple[Array, ...]]:
    """Return ends as float arrays."""
    return [tuple(np.array(p, dtype=np.float64) for p in ends) for ends in some]


def shares(a0, a1, b0, b1) -> tuple[float, float]:
    """Return where on two segments their closest points lie, 0 to 1."""
    p, o = distance.closest_points_segments(a0, a1, b0, b1)
    u, v = a1 - a0, b1 - b0
    return float((p - a0) @ u / (u @ u)), float((o - b0) @ v / (v @ v))


def closest(a0, a1, b0, b1, answer) -> bool:
    """Return whether each point of an answer is its segment's nearest to the other.

    The squared distance is convex, so that makes a closest pair of them.
    """
    if np.shape(answer) != (2, 3) or not np.isfinite(answer).all():
        return False
    size = max(np.linalg.norm(x) for x in (a1 - a0, b1 - b0, a0 - b0))
    return all(
        np.linalg.norm(_nearest(other, *ends) - mine) <= 1e-12 * size
        for mine, other, ends in (
            (answer[0], answer[1], (a0, a1)),
            (answer[1], answer[0], (b0, b1)),
        )
    )


def _nearest(x, start, end) -> Array:
    """Return the point of a segment that is nearest to x."""
    along = end - start
    size = along @ along
    return start + np.clip((x - start) @ along / (size or 1.0), 0.0, 1.0) * along


def crosses(a0, a1, b0, b1) -> bool:
    """Return whether neither is a point and their directions differ by 6 degrees."""
    u, v = a1 - a0, b1 - b0
    size = np.linalg.norm(u) * np.linalg.norm(v)
    return bool(np.linalg.norm(np.cross(u, v)) > 0.1 * size)


def kind(a0, a1, b0, b1) -> str:
    """Return whether both points are inside, one at an end, or both; "" if unclear."""
    if not crosses(a0, a1, b0, b1):
        return ""
    at = np.array(shares(a0, a1, b0, b1))
    if np.any((np.abs(at * (1 - at)) < 0.02) & (at * (1 - at) > 0)):
        return ""  # hardly inside: rounding, or too small a mistake, would decide
    return KINDS[int(np.sum(at * (1 - at) == 0))]


def segments(rng, wanted: str) -> tuple[Array, ...]:
    """Return two drawn segments of a kind; edge values may give another one."""
    for _ in range(300):
        a0, a1, b0, b1 = rng.numbers(-1, 1, 4, 3)
        if kind(a0, a1, b0, b1) == wanted:
            break
    return a0, a1, b0, b1


def at_ends(a0, a1, b0, b1) -> tuple[bool, bool]:
    """Return of two segments that cross or are skew which closest point is an end."""
    found = shares(a0, a1, b0, b1)
    return tuple(s < 1e-9 or s > 1 - 1e-9 for s in found)  # type: ignore[return-value]


def parallel(a0, a1, b0, b1) -> bool:
    """Return whether two segments, neither of them a point, are parallel."""
    u, v = a1 - a0, b1 - b0
    size = np.linalg.norm(u) * np.linalg.norm(v)
    return bool(size > 0 and np.linalg.norm(np.cross(u, v)) <= 1e-9 * size)


def point(a0, a1, b0, b1) -> bool:
    """Return whether one of two segments is a point, or both are."""
    return not ((a1 - a0).any() and (b1 - b0).any())


def of_ends(*wanted):
    """Return the case of segments whose closest points are ends, or not."""

    return lambda *call: _place(*call) == wanted


@once  # each of the cases asks it
def _place(*call):
    """Return which closest point is an end; None of parallel segments and points."""
    return None if point(*call) or parallel(*call) else at_ends(*call)


PLACES = {
    "segments whose closest points both lie between the endpoints": of_ends(
        False, False
    ),
    "segments of which only the first one is closest at an endpoint": of_ends(
        True, False
    ),
    "segments of which only the second one is closest at an endpoint": of_ends(
        False, True
    ),
    "segments whose closest points are both endpoints": of_ends(True, True),
    "parallel segments": parallel,
    "segments of length 0": point,
}


def seldom(rng) -> list[tuple[Array, ...]]:
    """Return segments of each of the PLACES: some of them are never drawn."""
    found = [segments(rng, one) for one in KINDS]
    found += [(b0, b1, a0, a1) for a0, a1, b0, b1 in found]
    along = rng.integers(-3, 4, 3).astype(float)
    along[int(rng.integers(3))] = 2.0
    for far in (1.0, 4.0):  # beside each other, and one behind the other
        start, shift = rng.integers(-3, 4, (2, 3)).astype(float)
        first = start + far * along + shift
        size = float(rng.choice([-2.0, -1.0, 0.5, 1.0, 2.0]))
        found.append((start, start + along, first, first + size * along))
        hardly = along + float(rng.choice([0.01, 0.05, 0.2])) * rng.numbers(-1, 1, 3)
        found.append((start, start + along, first, first + size * hardly))
    a, (b0, b1) = rng.numbers(-1, 1, 3), rng.numbers(-1, 1, 2, 3)
    return [*found, (a, a.copy(), b0, b1), (b0, b1, a, a.copy())]


def radii(rng) -> tuple[float, float]:
    """Return two drawn radii, m, the larger one of either."""
    small, large = float(rng.numbers(0.02, 0.1)), float(rng.numbers(0.12, 0.3))
    return (small, large) if rng.integers(2) else (large, small)


def turned(rng) -> Array:
    """Return a drawn pose, turned, (4, 4)."""
    return rng.poses(1, 2.0)[0]


def moved(rng) -> Array:
    """Return a drawn pose that is not turned, (4, 4)."""
    return se3.make_T(np.eye(3), rng.numbers(-2, 2, 3))


def around(rng, half: Array, T: Array, deep: bool) -> tuple[Array, Array]:
    """Return a segment in the world whose nearest point to a box is no end of it."""
    R, t = T[:3, :3], T[:3, 3]
    for _ in range(300):
        a0, a1 = rng.numbers(-1.5, 1.5, 2, 3)
        far = [
            distance.box_sdf(a0 + s * (a1 - a0), half) for s in np.linspace(0, 1, 41)
        ]
        if 4 < int(np.argmin(far)) < 36 and (min(far) < -0.02) == deep:
            break
    return np.round(R @ a0 + t, 4), np.round(R @ a1 + t, 4)

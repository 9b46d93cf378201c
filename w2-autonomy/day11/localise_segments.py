"""Where answers about segments and capsules of Day 11 are right, and where not."""

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array
from robo47.distance import closest_points_segments

from . import localise
from .localise import Group, Sorted

BOTH = "between the ends of both"
FIRST = "an end of the first alone"
SECOND = "an end of the second alone"
APART = "where they are apart"
OVERLAP = "where they overlap"
LEAD = "where the closest points are "
ENDS = "ends of both"
SIDE = "those of parallel axes"
POINT = "one point alone of an axis"


def kind(a0: Array, a1: Array, b0: Array, b1: Array) -> str:
    """Return in words where the closest points of two segments lie."""
    u, v = a1 - a0, b1 - b0
    if not (u.any() and v.any()):
        return POINT
    if np.linalg.norm(np.cross(u, v)) < 1e-6 * np.linalg.norm(u) * np.linalg.norm(v):
        return SIDE
    p, o = closest_points_segments(a0, a1, b0, b1)
    first = any(np.allclose(p, x) for x in (a0, a1))
    second = any(np.allclose(o, x) for x in (b0, b1))
    return {(0, 0): BOTH, (1, 0): FIRST, (0, 1): SECOND}.get((first, second), ENDS)


def nearest(p: Array, start: Array, end: Array) -> Array:
    """Return the point of a segment that is nearest to another one."""
    way = end - start
    square = way @ way
    return start + way * (np.clip((p - start) @ way / square, 0, 1) if square else 0.0)


def _off(found: Array, wanted: Array) -> float:
    return float(np.linalg.norm(found - wanted))


def closest(case: Case) -> Finding | None:
    """Return which of two points lies off its segment, or is not the nearest one."""
    all_ = localise.seen(case)
    pairs = list(zip(all_.calls, all_.S, strict=True))
    off = np.array([
        (_off(p, nearest(p, a0, a1)), _off(o, nearest(o, b0, b1)))
        for (a0, a1, b0, b1), (p, o) in pairs
    ])  # fmt: skip
    names = ("first's point", "second's point")
    if np.isfinite(off).all() and (off > 1e-6).any():
        beside = (off > 1e-6).any(axis=0)
        its = " and the ".join(n for n, bad in zip(names, beside, strict=True) if bad)
        on = "" if beside.all() else f" The {names[int(beside[0])]} lies on its own."
        says = (
            f"The {its} may lie off the segment, by up to {1000 * off.max():.4g} mm: "
            f"a0 + s u and b0 + t v with s and t from 0 to 1 are on them.{on}"
        )
        return Finding("off-the-segments", says)
    better = np.array([
        (_off(p, nearest(o, a0, a1)), _off(o, nearest(p, b0, b1)))
        for (a0, a1, b0, b1), (p, o) in pairs
    ])  # fmt: skip
    s, t = (better > 1e-6).any(axis=0)
    return _not_nearest(all_, bool(s), bool(t)) if s or t else None


def _not_nearest(all_: localise.Seen, s: bool, t: bool) -> Finding:
    """Return which share is not the best one, and for what kinds of segments."""
    more = max(_off(*x) - _off(*y) for x, y in zip(all_.S, all_.T, strict=True))
    says = (
        "All your points lie on their segments, up to "
        f"{1000 * more:.3g} mm farther apart than the closest. "
    )
    groups = {name: Group("") for name in (BOTH, FIRST, SECOND, ENDS)}
    by = localise.apart(all_, Sorted(groups, kind, LEAD))
    right = f" {by.message}" if by else ""
    if s and t:
        says += "Neither is always the nearest one to the other"
        if more < 0.05 and not by:
            says += ": are only some points tried, or is a loop not at its end"
            return Finding("nearly-the-closest", f"{says}?")
        return Finding("neither-nearest", f"{says}.{right}")
    mine, its = ("second's", "first's") if s else ("first's", "second's")
    share, other = ("s", "t") if s else ("t", "s")
    says += (
        f"The {mine} is the nearest to the {its}, but the {its} is not always the "
        f"nearest to the {mine}: {share} is not the best one for that {other}."
    )
    return Finding(f"{share}-not-the-best", says + right)


def gap(case: Case) -> Finding | None:
    """Return for which capsules a distance is right, or what is taken off."""
    all_ = localise.seen(case)
    large = localise.sizes(all_)

    def overlap(a0: Array, a1: Array, ra: float, *other: Array) -> str:
        p, o = closest_points_segments(a0, a1, *other[:2])
        deep = np.linalg.norm(p - o) < ra + other[2]
        return OVERLAP if deep else APART

    def place(a0: Array, a1: Array, ra: float, *other: Array) -> str:
        return kind(a0, a1, *other[:2])

    says = "No case is special here: it is |p - o| - ra - rb everywhere."
    deep = {APART: Group("wrong-apart", says), OVERLAP: Group("wrong-inside", says)}
    says = "Which points are p and o there?"
    slugs = ("between-the-ends", "at-an-end", "at-an-end", "at-both-ends",
             "side-by-side", "of-a-point")  # fmt: skip
    names = (BOTH, FIRST, SECOND, ENDS, SIDE, POINT)
    groups = {
        name: Group(f"wrong-{slug}", says)
        for name, slug in zip(names, slugs, strict=True)
    }
    found = localise.apart(all_, Sorted(deep, overlap), Sorted(groups, place, LEAD))
    if found:
        return Finding(found.slug, found.message + large)
    return _taken_off(all_, large)


def _taken_off(all_: localise.Seen, large: str) -> Finding | None:
    """Return what is taken off the axes' distance of equal radii, if one number."""
    same = all_.some([call[2] == 0.25 and call[5] == 0.5 for call in all_.calls])
    if len(same.calls) < 4:
        return None
    off = np.array([t + 0.75 - s for s, t in zip(same.S, same.T, strict=True)])
    if not np.isfinite(off).all():
        return None
    if np.ptp(off) < 1e-9:
        says = (
            f"From the distance of the axes {localise.number(off[0])} is taken off for "
            "ra = 0.25 and rb = 0.5, wherever they are; it is to be ra + rb = 0.75."
        )
        return Finding("other-radii", says)
    says = (
        "With equal radii, what you take off |p - o| is not always the same, so more "
        f"than the radii is wrong.{large} What is the length of p - o?"
    )
    return Finding("other-length", says)

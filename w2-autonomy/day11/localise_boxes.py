"""Where answers about the boxes of Day 11 are right, and where not."""

from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array
from robo47.distance import box_sdf

from . import localise
from .localise import Group, Sorted, number

DEPTH = "There it is the largest of |p| - half, which are all below 0."
ALONE = "There it is |p| - half of that one axis."
ROOT = "There it is the root of the sum of the squares of what is beyond."


def point(case: Case) -> Finding | None:
    """Return beyond how many faces a point's distance from a box is wrong."""
    all_ = localise.seen(case)
    names = ["beyond one face", "inside", "beyond two faces", "beyond three faces"]
    hints = [ALONE, DEPTH, ROOT, ROOT]
    slugs = ["one-face", "inside", "two-faces", "three-faces"]
    groups = {
        name: Group(f"wrong-{slug}", hint)
        for name, slug, hint in zip(names, slugs, hints, strict=True)
    }

    def faces(p: Array, half: Array) -> str:
        return names[[1, 0, 2, 3][int(np.sum(np.abs(p) > half))]]

    def folded(p: Array, half: Array) -> str:
        below = np.any(p < 0)
        return "an entry of p is below 0" if below else "none of p is below 0"

    def alike(p: Array, half: Array) -> str:
        return "the sides are alike" if np.ptp(half) < 1e-9 else "the sides differ"

    says = "The box is the same on all sides: fold p first."
    signs = {
        "an entry of p is below 0": Group("not-folded", says),
        "none of p is below 0": Group("folded-only", says),
    }
    says = "Each axis has its own half of a side."
    cubes = {
        "the sides are alike": Group("wrong-cubes", says),
        "the sides differ": Group("wrong-sides", says),
    }
    found = localise.apart(
        all_,
        Sorted(groups, faces),
        Sorted(signs, folded, "where "),
        Sorted(cubes, alike, "where "),
    )
    large = localise.sizes(all_)
    if found:
        return Finding(found.slug, found.message + large)
    says = f"It is wrong in all places, already beyond one face. {ALONE}"
    return Finding("wrong-one-face", says + large)


def capsule(case: Case) -> Finding | None:
    """Return for which poses, or where along the axis, a capsule's distance fails."""
    all_ = localise.seen(case)
    large = localise.sizes(all_)
    if found := localise.apart(all_, _by_pose(), _by_place()):
        return Finding(found.slug, found.message + large)
    if found := _of_another_point(all_):
        return found
    says = (
        "It is wrong wherever the box stands, also at the origin and not turned: there "
        f"it is the least of 11.3 along the axis, less r.{large}"
    )
    return Finding("wrong-anywhere", says)


def _by_pose() -> Sorted:
    def pose(a0: Array, a1: Array, r: float, T: Array, half: Array) -> str:
        if not np.allclose(T[:3, :3], np.eye(3)):
            return "turned"
        return "moved and not turned" if T[:3, 3].any() else "at the origin"

    says = "Into the box's axes a point is R^T (x - t), a way is R^T (a1 - a0)."
    groups = {
        "at the origin": Group("wrong-at-the-origin"),
        "moved and not turned": Group("wrong-moved", says),
        "turned": Group("wrong-turned", says),
    }
    return Sorted(groups, pose, "where the box is ")


def _by_place() -> Sorted:
    def place(a0: Array, a1: Array, r: float, T: Array, half: Array) -> str:
        far = _along(a0, a1, T, half)
        if far.min() < 0:
            return "in the box"
        return "an end" if far.argmin() in (0, len(far) - 1) else "between the ends"

    groups = {
        "between the ends": Group("wrong-between", "How is the valley cut?"),
        "an end": Group("wrong-at-an-end", "May the valley's bottom be an end?"),
        "in the box": Group("wrong-inside", "It is what 11.3 says there, too, less r."),
    }
    return Sorted(groups, place, "where the axis' nearest point is ")


def _along(a0: Array, a1: Array, T: Array, half: Array) -> Array:
    start, end = ((x - T[:3, 3]) @ T[:3, :3] for x in (a0, a1))
    shares = np.linspace(0, 1, 201)
    return np.array([box_sdf(start + s * (end - start), half) for s in shares])


def _of_another_point(all_: localise.Seen) -> Finding | None:
    """Return that all numbers are those of points of the axis, if not the nearest."""
    for (a0, a1, r, T, half), S in zip(all_.calls, all_.S, strict=True):
        far = _along(a0, a1, T, half)
        if not far.min() - 1e-3 <= S + r <= far.max() + 1e-9:
            return None
    more = max(float(s - t) for s, t in zip(all_.S, all_.T, strict=True))
    says = (
        "Each number is how far a point of the axis is, less r, but not always the "
        f"nearest one: up to {1000 * more:.3g} mm too large. Which part of the axis is "
        "kept, and how long is it in the end?"
    )
    return Finding("another-point", says)


def around(case: Case) -> Finding | None:
    """Return what of a box is right: its middle, its sides, one of its corners."""
    all_ = localise.seen(case)
    own, right = np.array(all_.S), np.array(all_.T)
    if not np.isfinite(own).all():
        return None
    middle, half = own.mean(axis=1), (own[:, 1] - own[:, 0]) / 2
    there, sides = right.mean(axis=1), (right[:, 1] - right[:, 0]) / 2
    if np.allclose(middle, there, 0, 1e-9):
        return _of_its_sides(all_, half)
    if np.allclose(half, sides, 0, 1e-9):
        says = (
            "The box is as large as it is to be, and stands elsewhere: its middle is "
            "that of a0 and a1."
        )
        return Finding("other-middle", says)
    wrong = (np.abs(own - right) > 1e-6).any(axis=0)  # (2, 3)
    for k in (0, 1):
        if not wrong[k].any():
            name, other = ("least", "greatest") if k == 0 else ("greatest", "least")
            says = f"The {name} corner is right, the {other} one is not{_holds(all_)}"
            return Finding(f"{other}-corner", says)
    good = [x for x, bad in zip("xyz", wrong.any(axis=0), strict=True) if not bad]
    if good:
        says = f"It is right in {localise.listed(good)} alone{_holds(all_)}"
        return Finding("some-axes", says)
    return Finding("other-box", f"Both corners are wrong{_holds(all_)}")


def _holds(all_: localise.Seen) -> str:
    """Return whether the student's boxes hold the capsule."""
    pairs = list(zip(all_.S, all_.T, strict=True))
    holds = [bool(np.all(s[0] <= t[0] + 1e-9) and np.all(s[1] >= t[1] - 1e-9))
             for s, t in pairs]  # fmt: skip
    small = [bool(np.all(s[0] >= t[0] - 1e-9) and np.all(s[1] <= t[1] + 1e-9))
             for s, t in pairs]  # fmt: skip
    if all(holds):
        return ": your box holds the capsule, and is larger than it has to be."
    if all(small):
        return ": your box lies in the right one, and does not hold the capsule."
    return (
        ": your box does not always hold the capsule. On each axis it goes from the "
        "lesser of a0 and a1, less r, to the greater one, and r more."
    )


def _of_its_sides(all_: localise.Seen, half: Array) -> Finding:
    """Return what half of the sides is made of, where the middle is right."""
    way = np.array([np.abs(a1 - a0) for a0, a1, _ in all_.calls])
    r = np.array([[r] * 3 for _, _, r in all_.calls])
    longest = np.repeat(way.max(axis=1), 3)
    length = np.repeat(np.linalg.norm(way, axis=1), 3)
    says = "The middle of the box is right, its sides are not"
    named = {"|a1 - a0| on that axis": way.ravel(), "the longest of |a1 - a0|": longest,
             "the axis' length": length}  # fmt: skip
    for name, column in named.items():
        found = localise.fitted(np.column_stack([column, r.ravel()]), half.ravel())
        if found is not None:
            made = f"{number(found[0])} times {name} and {number(found[1])} times r"
            says += f": half of a side is {made}"
            break
    return Finding(
        "other-sides", f"{says}; it is to be |a1 - a0| / 2 + r on each axis."
    )


def both(case: Case) -> Finding | None:
    """Return for which boxes True or False is wrong."""
    all_ = localise.seen(case)
    bad = all_.some(all_.wrong)
    of = [_lie(*call) for call in bad.calls]
    every = [_lie(*call) for call in all_.calls]
    true, false = (
        sorted({one for one, t in zip(of, bad.T, strict=True) if bool(t) is is_true})
        for is_true in (False, True)
    )

    def told(some: list[str]) -> str:
        part = {one for one in some if of.count(one) < every.count(one)}
        return localise.listed([one + " (some)" * (one in part) for one in some])

    parts = [f"it is True for boxes {told(true)}"] if true else []
    parts += [f"it is False for boxes {told(false)}"] if false else []
    says = f"{localise.listed(parts)}; everywhere else it is right."
    slug = "both-wrong" if true and false else "true-apart" if true else "false-overlap"
    return Finding(slug, says[0].upper() + says[1:] + _below(bad))


def _lie(A: Array, B: Array) -> str:
    """Return in words how two boxes lie."""
    out = (A[0] > B[1]) | (B[0] > A[1])
    if out.any():
        axes = [x for x, is_out in zip("xyz", out, strict=True) if is_out]
        alone = " alone" if len(axes) == 1 else ""
        return f"that are apart along {localise.listed(axes)}{alone}"
    if np.any((A[0] == B[1]) | (B[0] == A[1])):
        return "that only touch"
    if np.all((A[0] <= B[0]) & (B[1] <= A[1]) | (B[0] <= A[0]) & (A[1] <= B[1])):
        inside = [np.all((X[0] <= Y[0]) & (Y[1] <= X[1])) for X, Y in ((A, B), (B, A))]
        return (
            "one of which holds the other" if any(inside) else "that cross each other"
        )
    ends: Any = [bool(np.all((X[0] <= c) & (c <= X[1])))
                 for X, Y in ((A, B), (B, A)) for c in Y]  # fmt: skip
    if any(ends):
        return "of which a least or greatest corner lies in the other"
    return "that overlap without a least or greatest corner in the other"


def _below(bad: localise.Seen) -> str:
    """Return that B is always on one side of A, where it is so."""
    apart = [(A, B) for A, B in bad.calls if np.any((A[0] > B[1]) | (B[0] > A[1]))]
    if len(apart) < 3:
        return ""
    below = [np.any(A[0] > B[1]) for A, B in apart]
    above = [np.any(B[0] > A[1]) for A, B in apart]
    if all(below) and not any(above):
        return " B always lies below A on the axes on which they are apart."
    if all(above) and not any(below):
        return " B always lies above A on the axes on which they are apart."
    return ""

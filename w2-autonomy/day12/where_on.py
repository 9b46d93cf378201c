"""Where answers of Day 12's other functions are wrong: paths, shares, ranges, motions.

As in `where`: all that is said was tried, and is counted.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47 import planning
from robo47.checks import Array

from .ways import without_filling
from .where import NEAR, Asked, Kinds, calls, only

Z = 1.96


def of_a_cut(case: Case) -> Finding | None:
    """Say what is wrong with paths that were cut: points, edges, or too little cut."""
    asked = calls(case)
    longer: list[int] = []
    shorter: list[int] = []
    for k, one in enumerate(asked, 1):
        path, world, _ = one.arguments
        if not one.wrong_rows():
            continue
        mine, right = (without_filling(x[0]) for x in (one.mine, one.right))
        if found := _no_cut(mine, path, world, f"in call {k} of {len(asked)}"):
            return found
        (longer if len(mine) > len(right) else shorter).append(k)
    return _too_much_or_little(asked, longer, shorter)


def _no_cut(mine: Array, path: Array, world: Array, where: str) -> Finding | None:
    """Return what keeps a path from being a cut of another, or None."""
    rows = [np.flatnonzero(np.abs(path - x).max(axis=1) < NEAR) for x in mine]
    if odd := [i for i, row in enumerate(rows) if not len(row)]:
        says = f"Point {odd[0]} of its answer is no point of the path, {where}: only "
        return Finding("not-its-points", f"{says}points are left out, none is made.")
    at = [int(row[0]) for row in rows]
    if not at or at[0] != 0:
        return Finding("start-lost", f"The path's first point is missing, {where}.")
    if at[-1] != len(path) - 1:
        return Finding("end-lost", f"The path's last point is missing, {where}.")
    if any(j <= i for i, j in pairwise(at)):
        return Finding("other-order", f"Points stand in another order, {where}.")
    for i, j in pairwise(at):
        if j > i + 1 and not planning.disc_edge_free(path[i], path[j], world):
            says = f"It cuts from row {i} of the path to row {j}, {where}, where the "
            return Finding("cut-not-free", f"{says}edge between the two is not free.")
    return None


PAIRS: Kinds = {
    "no-pair": "where there is no pair",
    "second-larger": "where a pair's first number is the larger",
    "later-pairs": "where there is more than one pair",
    "blocked-pairs": "where an edge that a pair names is not free",
    "to-the-end": "where a pair names the last row",
}


def _too_much_or_little(
    asked: Sequence[Asked], longer: Sequence[int], shorter: Sequence[int]
) -> Finding | None:
    """Say whether valid cuts leave too much or too little, and with which pairs."""
    if not longer and not shorter:
        return None
    what, slug = "it leaves other points than asked for", "other-cuts"
    if not shorter:
        what, slug = "it keeps points that go", "cuts-missing"
    elif not longer and any(_fewer(asked[k - 1]) for k in shorter):
        what, slug = "it leaves out points that stay", "cuts-too-many"
    says = (
        f"What it leaves is a free path each time, but in {len(longer) + len(shorter)} "
        f"of {len(asked)} calls {what}. Go through call {min([*longer, *shorter])} "
        "pair by pair: which two rows does each name, of how many rows by then?"
    )
    found = only(PAIRS, [_of_pairs(one) for one in asked],
                 [one.wrong_rows() for one in asked])  # fmt: skip
    if found:
        return Finding(f"{slug}-{found.slug}", f"{found.message} {says}")
    return Finding(slug, says)


def _fewer(one: Asked) -> bool:
    return len(without_filling(one.mine[0])) < len(without_filling(one.right[0]))


def _of_pairs(one: Asked) -> dict[str, bool]:
    path, world, pairs = one.arguments
    m, blocked, last = len(path), False, False
    for pair in pairs:
        i, j = sorted(int(u * m) for u in pair)
        free = planning.disc_edge_free(path[i], path[j], world)
        blocked = blocked or (j - i > 1 and not free)
        last = last or j == m - 1
        if j - i > 1 and free:
            path = np.concatenate([path[: i + 1], path[j:]])
            m = len(path)
    swapped = bool((pairs[:, 0] > pairs[:, 1]).any())
    found = not len(pairs), swapped, len(pairs) > 1, blocked, last
    return dict(zip(PAIRS, found, strict=True))


SHARES: Kinds = {
    "no-trial": "where there is no trial, n = 0; there it is (0, 1)",
    "one-trial": "where there is one trial",
    "few-trials": "where there are fewer than ten trials",
    "no-success": "where no trial succeeds, k = 0",
    "all-succeed": "where all trials succeed, k = n",
    "none-or-all": "where none or all succeed; p (1 - p) is 0 there",
    "some-of-n": "where some succeed and some do not; p (1 - p) is not 0 there",
}


def of_shares(case: Case) -> Finding | None:
    """Say of an interval which z it has, or whether its middle or width is wrong."""
    asked = calls(case)
    features = []
    for one in asked:
        k, n = map(int, one.arguments)
        none, whole = k == 0 and n > 0, k == n and n > 0
        of = (n == 0, n == 1, n < 10, none, whole, none or whole, 0 < k < n)
        features.append(dict(zip(SHARES, of, strict=True)))
    trials = [one for one in asked if one.arguments[1] > 0]
    if found := _of_z(trials):
        return found
    told = only(SHARES, features, [one.wrong() for one in asked])
    ends = _ends(trials)
    if told and told.slug != "none-or-all":
        return Finding(told.slug, f"{told.message}{ends}")
    return Finding("another-interval", f"{told.message if told else ''}{ends}".strip(
        )) if told or ends else None  # fmt: skip


def _of_z(trials: Sequence[Asked]) -> Finding | None:
    """Return that an interval is Wilson's, or Wald's, with another z."""
    wilson, wald = [], []
    for one in trials:
        k, n = one.arguments
        p = k / n
        with np.errstate(all="ignore"):
            wilson += list(np.abs(one.mine[0] - p) * np.sqrt(
                n / (one.mine[0] * (1 - one.mine[0]))))  # fmt: skip
            if 0 < k < n:
                wald += list(np.abs(one.mine[0] - p) / np.sqrt(p * (1 - p) / n))
    kinds = (
        ("asked for is that", wilson),
        ("as Wald's, p +- z sqrt(p (1 - p) / n)", wald),
    )
    for how, some in kinds:
        zs = np.array(some)[np.isfinite(some)]
        if len(zs) > 5 and np.ptp(zs) < 1e-6 and abs(zs[0] - Z) > 1e-5 and zs[0] > 0:
            says = f"z is {zs[0]:.4g} in every call, {how}; 95 % of a normal noise lie "
            return Finding("another-z", f"{says}within 1.96 sigma.")
    return None


def _ends(trials: Sequence[Asked]) -> str:
    """Return which of middle, width, low and high end are right, in words."""
    mine, right = (np.array([x[i][0] for x in trials]) for i in (1, 2))
    if not np.isfinite(mine).all():
        return ""
    says = ""
    off = [np.abs(f(mine) - f(right)).max() < NEAR for f in (_middle, _width)]
    if off == [True, False]:
        says = " The middle is right, the width is not: look at the root."
    elif off == [False, True]:
        says = " The width is right, the middle is not."
    if (beyond := (mine < -NEAR) | (mine > 1 + NEAR)).any():
        says += f" No share is below 0 or above 1: {mine[beyond][0]:.3f} is none."
    if not says:
        by = (np.abs(_width(mine)) > np.abs(_width(right))).mean()
        how = "wider" if by > 0.5 else "narrower"
        says = " Neither the middle nor the width is right"
        says += f"; it is {how} than asked for in {max(by, 1 - by):.0%} of the calls."
        says += " Work out wilson(18, 60) by hand, term by term."
    return says


def _middle(ends: Array) -> Array:
    return ends.mean(axis=1)


def _width(ends: Array) -> Array:
    return ends[:, 1] - ends[:, 0]


RANGES: Kinds = {
    "at-rest": "where sd is 0",
    "joint-at-rest": "where a joint has a = 0",
    "cannot-hold": "where a joint with a = 0 cannot hold its torque; that allows none",
    "no-joint-moves": "where no joint moves, all a are 0",
    "none-allowed": "where none is allowed, the least above the greatest",
    "not-around-0": "where sdd 0 is not allowed",
    "negative-a": "where some a is below 0",
    "gravity": "where g is not 0",
    "speed": "where b sd^2 is not 0",
    "many-joints": "where there are more than two joints",
}


def of_a_range(case: Case) -> Finding | None:
    """Say for which joints and which end `accel_range` is wrong."""
    asked = calls(case)
    features = [_of_joints(one) for one in asked]
    found = only(RANGES, features, [one.wrong() for one in asked])
    ends = [[_other(one.mine[0][i], one.right[0][i]) for one in asked] for i in (0, 1)]
    says = ""
    for i, name in enumerate(("least", "greatest")):
        if any(ends[i]) and not any(ends[1 - i]):
            says = (
                f" Only the {name} is wrong, in {sum(ends[i])} of {len(asked)} calls."
            )
    says += _wider(asked)
    if found:
        return Finding(found.slug, found.message + says)
    return Finding("another-range", says.strip()) if says else None


def _other(mine: Any, right: Any) -> bool:
    return not (mine == right or abs(mine - right) <= NEAR)


def _of_joints(one: Asked) -> dict[str, bool]:
    a, b, g, limits, sd = one.arguments
    rest = b * sd**2 + g
    stuck = (a == 0) & (np.abs(rest) > limits)
    low, high = one.right[0]
    found = (
        sd == 0, bool((a == 0).any()), bool(stuck.any()), not a.any(), low > high,
        not low <= 0 <= high, bool((a < 0).any()), bool(g.any()), bool((b * sd).any()),
        len(a) > 2,
    )  # fmt: skip
    return dict(zip(RANGES, found, strict=True))


def _wider(asked: Sequence[Asked]) -> str:
    """Return whether wrong ranges always lie in, or around, the right ones."""
    bad = [one for one in asked if one.wrong()]
    pairs = [(one.mine[0], one.right[0]) for one in bad]
    pairs = [(s, t) for s, t in pairs if s[0] <= s[1] and t[0] <= t[1]]
    if len(pairs) < 3:
        return ""
    if all(s[0] <= t[0] + NEAR and s[1] >= t[1] - NEAR for s, t in pairs):
        return (
            " Its ranges hold the right ones: some joint, or torque, limits too little."
        )
    if all(s[0] >= t[0] - NEAR and s[1] <= t[1] + NEAR for s, t in pairs):
        return " Its ranges lie within the right ones: something limits too much."
    return ""


MOTIONS: Kinds = {
    "cannot-hold": "where gravity alone is above a limit; zeros are asked for",
    "can-hold": "where gravity alone is within all limits",
    "several-joints": "where there are several joints",
    "slow-motors": "where the motors' speed, x_max, is the limit at some point",
    "gravity": "where there is gravity",
    "coriolis": "where B is not 0",
    "not-at-speed": "where some speed below x_max leaves no sdd",
}


def of_a_motion(case: Case) -> Finding | None:
    """Say of a motion which limit it breaks first, or where it is too slow."""
    asked = calls(case)
    features = [_of_path(one) for one in asked]
    found = only(MOTIONS, features, [one.wrong() for one in asked])
    told = found.message + " " if found else ""
    if found and found.slug == "cannot-hold":
        return found
    for k, one in enumerate(asked, 1):
        if not one.wrong() or not np.isfinite(one.mine[0]).all():
            continue
        if broken := _broken(one):
            slug, says = broken
            return Finding(slug, f"{told}In call {k} of {len(asked)} {says}")
    slow = _slow(asked)
    return Finding("slower-than-possible", told + slow) if slow else found


def _of_path(one: Asked) -> dict[str, bool]:
    A, B, G, limits, x_max = one.arguments
    right = one.right[0][: len(A)]
    heavy = bool((np.abs(G) > limits).any())
    ends = [
        planning.accel_range(A[i], B[i], G[i], limits, np.sqrt(x_max[i]))
        for i in range(len(A))
    ]
    found = (
        heavy, not heavy, A.shape[1] > 1,
        not heavy and bool((np.abs(right - x_max) < NEAR).any()), bool(G.any()),
        bool(B.any()), any(low > high for low, high in ends),
    )  # fmt: skip
    return dict(zip(MOTIONS, found, strict=True))


def _broken(one: Asked) -> tuple[str, str] | None:
    """Return the first limit that a motion breaks: its name and how, or None."""
    A, B, G, limits, x_max = one.arguments
    x = one.mine[0][: len(A)]
    n = len(A) - 1
    for end, i in (("begins", 0), ("ends", n)):
        if abs(x[i]) > NEAR:
            return f"{end}-in-motion", f"it {end} in motion: sd^2 is {x[i]:.3f} there."
    if (x < -NEAR).any():
        return "below-zero", f"sd^2 is below 0 at point {int(np.argmax(x < -NEAR))}."
    if (fast := x > x_max + NEAR).any():
        i = int(np.argmax(fast))
        says = f"sd^2 is {x[i]:.3f} at point {i}, and x_max {x_max[i]:.3f}."
        return "faster-than-the-motors", says
    for i in range(n):
        u = (x[i + 1] - x[i]) * n / 2
        low, high = planning.accel_range(
            A[i], B[i], G[i], limits, np.sqrt(max(x[i], 0))
        )
        if not low - 1e-5 <= u <= high + 1e-5:
            says = (
                f"sdd from point {i} to the next is {u:.3f}, (x[{i + 1}] - x[{i}]) / "
            )
            allowed = f"the torques allow {low:.3f} to {high:.3f} at point {i}"
            if low > high:
                allowed = f"at that speed the torques allow none at point {i}"
            return "beyond-the-torques", f"{says}(2 ds), and {allowed}."
    return None


def _slow(asked: Sequence[Asked]) -> str:
    """Return where a motion that keeps all limits is slower than the fastest, or ""."""
    for k, one in enumerate(asked, 1):
        mine, right = one.mine[0], one.right[0]
        if one.wrong() and np.isfinite(mine).all():
            i = int(np.argmax(right - mine))
            return (
                "It keeps all limits, and is slower than need be: in call "
                f"{k} of {len(asked)} sd^2 is {mine[i]:.3f} at point {i}, and "
                f"{right[i]:.3f} is possible."
            )
    return ""

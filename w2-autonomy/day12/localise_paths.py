"""Where answers of Day 12's other functions are wrong: paths, shares, ranges, motions.

As in `where`: all that is said was tried, and is counted.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array

from .intervals import OPTIONS, interval_of
from .localise import NEAR, Asked, Kinds, calls, only
from .options import together

Z = 1.96
FAR = 1e-3  # two z that are not the same


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
    given = [(int(one.arguments[0]), int(one.arguments[1])) for one in asked]
    found = _of_z(trials)
    if found := found or together(
        OPTIONS, interval_of, given, [x.mine[0] for x in asked]
    ):
        return found
    told = only(SHARES, features, [one.wrong() for one in asked])
    if told and told.slug not in ("none-or-all", "some-of-n"):
        return told
    ends = _ends([one for one in trials if one.wrong()])
    says = f"{told.message} {ends}" if told else ends
    return Finding(told.slug if told else "another-interval", says) if says else None


def _of_z(trials: Sequence[Asked]) -> Finding | None:
    """Return that an interval is Wilson's, or Wald's, with another z."""
    wilson, wald = [], []
    for one in trials:
        k, n = one.arguments
        p = k / n
        for x in one.mine[0]:
            if NEAR < x < 1 - NEAR:
                wilson.append(abs(x - p) * np.sqrt(n / (x * (1 - x))))
            if 0 < k < n:
                wald.append(abs(x - p) / np.sqrt(p * (1 - p) / n))
    kinds = (
        ("in the formula that is asked for", wilson),
        ("in Wald's formula, p +- z sqrt(p (1 - p) / n), which is another", wald),
    )
    for how, some in kinds:
        zs = np.array(some)[np.isfinite(some)]
        if len(zs) > 5 and np.ptp(zs) < 1e-6 and abs(zs[0] - Z) > 1e-5 and zs[0] > 0:
            says = f"z is {zs[0]:.4g} in every call, {how}; 95 % of a normal noise lie "
            return Finding("another-z", f"{says}within 1.96 sigma.")
    pairs = [z for z in (_both_z(one) for one in trials) if z]
    if len(pairs) > 5 and all(abs(low - high) < 1e-6 for low, high in pairs):
        least, most = min(pairs)[0], max(pairs)[0]
        says = f"z is {least:.4g} to {most:.4g}, in the formula that is asked for"
        if most - least > FAR:
            return Finding("z-changes", f"{says}; it is 1.96 for all n.")
    return None


def _both_z(one: Asked) -> tuple[float, float] | None:
    """Return the z of either end in the formula asked for, where both tell it."""
    k, n = one.arguments
    low, high = one.mine[0]
    if not (NEAR < low < 1 - NEAR and NEAR < high < 1 - NEAR):
        return None
    first, other = (abs(x - k / n) * np.sqrt(n / (x * (1 - x))) for x in (low, high))
    return float(first), float(other)


def _ends(trials: Sequence[Asked]) -> str:
    """Return which of ends, middle and width are right, in words, of wrong answers."""
    if not trials:
        return ""
    mine, right = (np.array([x[i][0] for x in trials]) for i in (1, 2))
    if not np.isfinite(mine).all():
        return ""
    off = np.abs(mine - right).max(axis=0) > NEAR
    parts = [np.abs(f(mine) - f(right)).max() < NEAR for f in (_middle, _width)]
    if off.sum() == 1:
        says = f"Only the {('low', 'high')[int(np.argmax(off))]} end is wrong."
    elif any(parts):
        one, other = ("middle", "width") if parts[0] else ("width", "middle")
        says = f"The {one} is right, the {other} is not."
    elif np.ptp(right * mine.sum() - mine * right.sum()) < NEAR * abs(mine.sum()):
        says = f"Each end is {mine.sum() / right.sum():.4g} times what it is to be."
    else:
        says = "Neither the middle of the two nor their width is right."
    if (beyond := (mine < -NEAR) | (mine > 1 + NEAR)).any():
        says += f" No share is below 0 or above 1: {mine[beyond][0]:.3f} is none."
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
    """Say for which joints and which end `path_accel_bounds` is wrong."""
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
    if not says:
        says = "; ".join(
            f"the {name} is wrong in {sum(off)} of {len(asked)} calls"
            for name, off in zip(("least", "greatest"), ends, strict=True)
        ).capitalize()
        says += ". Work out both quotients of one joint, and what all joints allow."
    return Finding("another-range", says.strip())


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


ROWS: Kinds = {
    "one-joint": "where there is one joint",
    "coupled": "where M has entries off its diagonal",
    "curved": "where ddq is not 0",
    "many-joints": "where there are more than two joints",
}
NAMES = "a", "b", "g"


def of_a_path(case: Case) -> Finding | None:
    """Say which of a, b and g is wrong, and for which arms and paths."""
    asked = calls(case)
    features, wrong = [], []
    for one in asked:
        M, _, ddq, _, _ = one.arguments
        k = len(M)
        coupled = bool((M - np.diag(M.diagonal())).any())
        of = (k == 1, coupled, bool(ddq.any()), k > 2)
        features.append(dict(zip(ROWS, of, strict=True)))
        off = np.abs(one.mine[0][:, :k] - one.right[0][:, :k])
        wrong.append(~np.all(off <= NEAR, axis=1))
    rows = np.any(wrong, axis=0)
    bad = [name for name, is_bad in zip(NAMES, rows, strict=True) if is_bad]
    good = [name for name, is_bad in zip(NAMES, rows, strict=True) if not is_bad]
    found = only(ROWS, features, np.any(wrong, axis=1), least=0.5)
    if not good and not found:
        return None
    right = (
        f"{' and '.join(good)} {'is' if len(good) == 1 else 'are'} right in all calls"
    )
    says = f"Of a, b and g {right if good else 'none is right'}; look at "
    says += f"{' and '.join(bad)}."
    says += f" {found.message}" if found else ""
    return Finding(f"wrong-{'-'.join(bad)}", says)

"""Intervals that are made with other parts than Wilson's."""

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array

from .options import NEAR, Asked, Option, calls, together

Z = 1.96
FAR = 1e-3  # two z that are not the same
USUAL: dict[str, Any] = {
    "z": Z,
    "p": lambda k, n: k / n,
    "moved": lambda z, n: z**2 / (2 * n),
    "front": lambda z: z,
    "noise": lambda p, n: p * (1 - p) / n,
    "more": lambda z, n: z**2 / (4 * n**2),
    "below": lambda z, n: 1 + z**2 / n,
    "below_width": None,
    "around": lambda a, n: a,
    "out": lambda ends, n: ends,
    "none": (0.0, 1.0),
    "without": lambda k, n: n == 0,
}


def interval_of(k: int, n: int, **how: Any) -> Array:
    """Return an interval, made with other parts.

    Args:
        k, n: as wilson_interval has them.
        how: what differs:
            z: of the normal noise.
            p: the share, from k and n.
            moved: by what the middle is moved, before the division.
            front: what stands before the root, from z.
            noise, more: the two terms under the root.
            below: what middle and width are divided by; `below_width` the width alone.
            around: what is done with the half width.
            out: what is done with both ends.
            none: the answer where `without` says that there is no trial.
    """
    o = SimpleNamespace(**{**USUAL, **how})
    if o.without(k, n):
        return np.array(o.none)
    n = n or 1
    p = o.p(k, n)
    below = o.below(o.z, n)
    width = o.below_width(o.z, n) if o.below_width else below
    under = o.noise(p, n) + o.more(o.z, n)
    half = o.around(o.front(o.z) * np.sqrt(under) / width, n)
    middle = (p + o.moved(o.z, n)) / below
    return o.out(np.array([middle - half, middle + half]), n)


def _each(key: str, rows: list[tuple[str, str, Any]]) -> list[Option]:
    return [Option(slug, says, {key: value}) for slug, says, value in rows]


OPTIONS = [
    *_each("z", [
        ("ninety", "your z is 1.645. Use 1.96", 1.645),
        ("two-sigma", "your z is 2. Use 1.96 instead", 2.0),
        ("one-sigma", "your z is 1. Use 1.96", 1.0),
        ("ninety-nine", "your z is 2.576. Use 1.96", 2.576),
        ("half-z", "your z is 0.98. Use 1.96", 0.98),
    ]),
    *_each("p", [
        ("one-more", "your p is (k + 1) / (n + 2). Use k / n",
         lambda k, n: (k + 1) / (n + 2)),
        ("half-more", "your code uses p = (k + 1/2) / (n + 1). Use p = k / n instead",
         lambda k, n: (k + 0.5) / (n + 1)),
        ("two-more", "your code uses p = (k + 2) / (n + 4). Use p = k / n instead",
         lambda k, n: (k + 2) / (n + 4)),
        ("n-plus-one", "your code uses p = k / (n + 1). Use p = k / n instead",
         lambda k, n: k / (n + 1)),
        ("n-less-one", "your code uses p = k / (n - 1). Use p = k / n instead",
         lambda k, n: k / max(n - 1, 1)),
        ("whole-division", "your code uses p = k // n, which is 0 or 1. Use p = k / n "
                           "instead",
         lambda k, n: k // n),
        ("shifted-p", "your code uses p = (k + z^2 / 2) / (n + z^2), which is the "
                      "centre of the interval. Use p = k / n instead",
         lambda k, n: (k + Z**2 / 2) / (n + Z**2)),
        ("failures", "your code uses the fraction of failures as p. Use p = k / n "
                     "instead",
         lambda k, n: (n - k) / n),
    ]),
    *_each("moved", [
        (slug, f"your code adds {says} to k / n in the centre. Add z^2 / (2 n) "
               "instead", of)
        for slug, says, of in (
            ("centre-not-moved", "nothing", lambda z, n: 0.0),
            ("two-n", "z^2 / n", lambda z, n: z**2 / n),
            ("z-for-z2", "z / (2 n)", lambda z, n: z / (2 * n)),
            ("z-for-z2", "z / n", lambda z, n: z / n),
            ("n-forgotten", "z^2 / 2", lambda z, n: z**2 / 2),
            ("four-n", "z^2 / (4 n)", lambda z, n: z**2 / (4 * n)),
            ("n-squared", "z^2 / (2 n^2)", lambda z, n: z**2 / (2 * n**2)),
            ("moved-back", "-z^2 / (2 n)", lambda z, n: -(z**2) / (2 * n)),
            ("one-for-z2", "1 / (2 n)", lambda z, n: 1 / (2 * n)))
    ]),
    *_each("front", [
        ("z-forgotten", "your half-width omits the factor z. Multiply the square "
                        "root by z", lambda z: 1.0),
        ("z-squared", "your half-width contains the factor z^2 instead of z. Multiply "
                      "the square root by z",
         lambda z: z * z),
        ("half-width", "your half-width contains the factor z / 2 instead of z. "
                       "Multiply the square root by z",
         lambda z: z / 2),
    ]),
    *_each("noise", [
        (slug, f"your code uses {says} under the square root. Use `p (1 - p) / n` "
               "instead", of)
        for slug, says, of in (
            ("n-less-one", "p (1 - p) / (n - 1)",
             lambda p, n: p * (1 - p) / max(n - 1, 1)),
            ("n-plus-z2", "p (1 - p) / (n + z^2)",
             lambda p, n: p * (1 - p) / (n + Z**2)),
            ("root-n-forgotten", "p (1 - p)", lambda p, n: p * (1 - p)),
            ("n-squared", "p (1 - p) / n^2", lambda p, n: p * (1 - p) / n**2),
            ("failures-forgotten", "p / n", lambda p, n: p / n),
            ("p-squared", "p^2 / n", lambda p, n: p * p / n),
            ("widest-noise", "1 / (4 n)", lambda p, n: 0.25 / n),
            ("noise-forgotten", "0 for p (1 - p) / n", lambda p, n: 0.0))
    ]),
    *_each("more", [
        (slug, f"your code uses {says} as the second term under the square root. Use "
               "z^2 / (4 n^2) instead", of)
        for slug, says, of in (
            ("width-without-z2", "0", lambda z, n: 0.0),
            ("n-for-n2", "z^2 / (4 n)", lambda z, n: z**2 / (4 * n)),
            ("four-forgotten", "z^2 / n^2", lambda z, n: z**2 / n**2),
            ("two-for-four", "z^2 / (2 n^2)", lambda z, n: z**2 / (2 * n**2)),
            ("z-for-z2", "z / (4 n^2)", lambda z, n: z / (4 * n**2)),
            ("one-for-z2", "1 / (4 n^2)", lambda z, n: 1 / (4 * n**2)),
            ("n2-forgotten", "z^2 / 4", lambda z, n: z**2 / 4),
            ("two-n", "z^2 / (2 n)", lambda z, n: z**2 / (2 * n)),
            ("taken-off", "-z^2 / (4 n^2)", lambda z, n: -(z**2) / (4 * n**2)))
    ]),
    *_each("below", [
        (slug, f"your code {does}. Divide both by 1 + z^2 / n", of)
        for slug, does, of in (
            ("not-divided", "does not divide the centre and the half-width",
             lambda z, n: 1.0),
            *((slug, f"divides the centre and the half-width by {says}", of)
              for slug, says, of in (
                ("n-times", "n + z^2", lambda z, n: n + z**2),
                ("two-n-below", "1 + z^2 / (2 n)", lambda z, n: 1 + z**2 / (2 * n)),
                ("z-below", "1 + z / n", lambda z, n: 1 + z / n),
                ("n2-below", "1 + z^2 / n^2", lambda z, n: 1 + z**2 / n**2),
                ("z2-alone", "1 + z^2", lambda z, n: 1 + z**2))))
    ]),
    *_each("below_width", [
        (slug, f"your code {does}. Divide the centre and the half-width by 1 + z^2 / n",
         of)
        for slug, does, of in (
            ("width-not-divided", "does not divide the half-width", lambda z, n: 1.0),
            ("width-by-n", "divides the half-width by n", lambda z, n: float(n)),
            ("usual-width", "divides only the half-width by 1 + z^2 / n",
             lambda z, n: 1 + z**2 / n),
            ("root-below", "divides the half-width by the root of 1 + z^2 / n",
             lambda z, n: np.sqrt(1 + z**2 / n)))
    ]),
    *_each("around", [
        ("continuity", "your code adds 1 / (2 n) to the half-width, as in a "
                       "continuity correction. Omit this term",
         lambda a, n: a + 1 / (2 * n)),
        ("half-width", "your code returns an interval that is half as wide as the "
                       "Wilson interval. Add and subtract the whole half-width",
         lambda a, n: a / 2),
        ("not-rooted", "your code squares the half-width. Add and subtract the "
                       "half-width itself", lambda a, n: a * a),
    ]),
    *_each("out", [
        ("percent", "your code returns per cent. Return fractions instead",
         lambda ends, n: 100 * ends),
        ("counts", "your code returns counts. Return fractions instead",
         lambda ends, n: n * ends),
        ("cut", "your code clamps the endpoints to [0.01, 0.99]. Omit this clamp",
         lambda ends, n: np.clip(ends, 0.01, 0.99)),
        ("cut", "your code clamps the endpoints to [0, 1]. Omit this clamp, because "
                "the endpoints of a Wilson interval never lie outside this range",
         lambda ends, n: np.clip(ends, 0, 1)),
        ("high-first", "your code returns the upper endpoint first. Return the lower "
                       "endpoint first",
         lambda ends, n: ends[::-1]),
        ("low-is-zero", "your code always returns 0 as the lower endpoint. Compute "
                        "the lower endpoint too, because the interval has two sides",
         lambda ends, n: np.array([0.0, ends[1]])),
        ("high-is-one", "your code always returns 1 as the upper endpoint. Compute "
                        "the upper endpoint too, because the interval has two sides",
         lambda ends, n: np.array([ends[0], 1.0])),
        ("low-alone", "your code returns the lower endpoint twice. Return both "
                      "endpoints",
         lambda ends, n: ends[[0, 0]]),
        ("high-alone", "your code returns the upper endpoint twice. Return both "
                       "endpoints",
         lambda ends, n: ends[[1, 1]]),
        ("middle-and-width", "your code returns the centre and the half-width. Return "
                             "the two endpoints instead", lambda ends, n:
         np.array([ends.mean(), np.diff(ends)[0] / 2])),
    ]),
    *_each("none", [
        ("none-is-zero", "for n = 0, your code returns (0, 0). Return (0, 1)",
         (0.0, 0.0)),
        ("none-is-half", "for n = 0, your code returns (1/2, 1/2). Return (0, 1)",
         (0.5, 0.5)),
        ("none-is-one", "for n = 0, your code returns (1, 1). Return (0, 1)",
         (1.0, 1.0)),
        ("none-is-turned", "for n = 0, your code returns (1, 0). Return (0, 1)",
         (1.0, 0.0)),
    ]),
    *_each("without", [
        ("no-success-is-none", "your code treats k = 0 like n = 0. Use the formula, "
                               "because only n = 0 is a special case",
         lambda k, n: k == 0),
        ("all-is-none", "your code treats k = n like n = 0. Use the formula, because "
                        "only n = 0 is a special case",
         lambda k, n: k == n),
        ("one-is-none", "your code treats n = 1 like n = 0. Use the formula, because "
                        "only n = 0 is a special case", lambda k, n: n < 2),
        ("few-are-none", "your code treats n < 5 like n = 0. Use the formula, because "
                         "only n = 0 is a special case",
         lambda k, n: n < 5),
    ]),
]  # fmt: skip


def of_shares(case: Case) -> Finding | None:
    """Say of intervals which z they have, or which options make them."""
    asked = calls(case)
    given = [(int(one.arguments[0]), int(one.arguments[1])) for one in asked]
    trials = [one for one in asked if one.arguments[1] > 0]
    mine = [one.mine[0] for one in asked]
    return _of_z(trials) or together(OPTIONS, interval_of, given, mine)


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
        ("Your intervals follow Wilson's formula", wilson),
        (
            "For 0 < k < n, your intervals follow Wald's formula "
            "p +- z sqrt(p (1 - p) / n)",
            wald,
        ),
    )
    for how, some in kinds:
        zs = np.array(some)[np.isfinite(some)]
        if len(zs) > 5 and np.ptp(zs) < 1e-6 and abs(zs[0] - Z) > 1e-5 and zs[0] > 0:
            says = f"{how} with z = {zs[0]:.4g}. Use Wilson's formula with z = 1.96, "
            return Finding("another-z", f"{says}which gives a 95 % interval.")
    pairs = [z for z in (_both_z(one) for one in trials) if z]
    if len(pairs) > 5 and all(abs(low - high) < 1e-6 for low, high in pairs):
        least, most = min(pairs)[0], max(pairs)[0]
        says = "Your intervals follow Wilson's formula with different values of z, "
        says += f"from {least:.4g} to {most:.4g}"
        if most - least > FAR:
            return Finding("z-changes", f"{says}. Use 1.96 for all n.")
    return None


def _both_z(one: Asked) -> tuple[float, float] | None:
    """Return the z of either end in the formula asked for, where both tell it."""
    k, n = one.arguments
    low, high = one.mine[0]
    if not (NEAR < low < 1 - NEAR and NEAR < high < 1 - NEAR):
        return None
    first, other = (abs(x - k / n) * np.sqrt(n / (x * (1 - x))) for x in (low, high))
    return float(first), float(other)

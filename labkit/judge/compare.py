"""How far apart two sets of answers are, as a number and in words."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47.checks import Array, pose_flaw, rotation_flaw

Parts = tuple[Array, ...]  # of answers: per result that the function returns, (n, ...)
MATCHES = 1e-5  # "this is the mistake": wide enough for a student's float32
RIGID = 1e-5  # how far R R^T may be from I before we call it no rotation


def gap(a: Array, b: Array) -> Array:
    """Return how far apart entries are, (n, ...); one NaN is inf."""
    with np.errstate(invalid="ignore"):
        alike = (a == b) | (np.isnan(a) & np.isnan(b))  # inf equals inf, NaN NaN
        apart = np.where(alike, 0.0, np.abs(a - b))
    return np.nan_to_num(apart, nan=np.inf, posinf=np.inf)


def difference(a: Array, b: Array, scale: float | Array = 1.0) -> Array:
    """Return the largest difference of any entry per case, (n,); one NaN is inf.

    Args:
        a: (n, ...).
        b: the same.
        scale: what it is measured in: a number, or an array with one for each entry.
    """
    return (gap(a, b) / scale).reshape(len(a), -1).max(axis=1, initial=0.0)


def matches(a: Array, b: Array, scale: float | Array = 1.0) -> bool:
    """Return whether a is b at every case, within rounding of b's largest entry.

    Args:
        a: (n, ...).
        b: the same.
        scale: what an entry is like, where b's are all small; as in `difference`.
    """
    if a.shape != b.shape:
        return False
    size = largest(b, scale)
    return bool(difference(a, b, scale).max(initial=0.0) <= MATCHES * max(1.0, size))


def largest(a: Array, scale: float | Array = 1.0) -> float:
    """Return the largest finite entry, in units of a scale."""
    sizes = np.abs(a / np.asarray(scale))
    return float(sizes[np.isfinite(sizes)].max(initial=0.0))


def as_one(some: Sequence[ArrayLike]) -> Array:
    """Return arrays as one, (n, ...); smaller ones are filled up with zeros."""
    arrays = [np.asarray(one, dtype=np.float64) for one in some]
    sizes = zip(*(one.shape for one in arrays), strict=True)  # refuses other depths
    whole = np.zeros((len(arrays), *map(max, sizes)))
    for at, one in enumerate(arrays):
        place: tuple[Any, ...] = (at, *map(slice, one.shape))
        whole[place] = one
    return whole


def as_one_size(a: Array, b: Array) -> tuple[Array, Array]:
    """Return two arrays (n, ...) with the smaller one filled up with zeros."""
    if a.shape == b.shape:
        return a, b
    both = as_one([a, b])
    return both[0], both[1]


def parts(answers: Any) -> Parts:
    """Return answers as a tuple of parts, also where there is one."""
    some = answers if isinstance(answers, tuple) else (answers,)
    return tuple(np.asarray(part, dtype=np.float64) for part in some)


def plain(some: Parts) -> Any:
    """Return answers as the function does: a tuple only where it has several parts."""
    return some[0] if len(some) == 1 else some


def gaps(kinds: Sequence[Any], S: Parts, T: Parts) -> Array:
    """Return per call the largest difference of an entry, in units of its scale."""
    trios = zip(S, T, kinds, strict=True)
    each = [difference(*as_one_size(s, t), kind.scale) for s, t, kind in trios]
    return np.max(each, axis=0)


def all_match(kinds: Sequence[Any], S: Parts, T: Parts) -> bool:
    """Return whether answers have as many parts, and each part `matches`."""
    trios = zip(S, T, kinds, strict=False)
    return len(S) == len(T) and all(matches(s, t, kind.scale) for s, t, kind in trios)


def off_by(kinds: Sequence[Any], S: Parts, T: Parts) -> float:
    """Return the largest difference of any entry, in units of its scale."""
    return float(gaps(kinds, S, T).max())


def worst_part(kinds: Sequence[Any], S: Parts, T: Parts, near: float) -> int:
    """Return the first part of an answer that is wrong, or the one furthest off."""
    trios = zip(S, T, kinds, strict=True)
    off = [off_by([kind], (s,), (t,)) for s, t, kind in trios]
    return next((i for i, x in enumerate(off) if x > near), int(np.argmax(off)))


def rigid(M: Array) -> bool:
    """Return whether all of M, (n, 3, 3) or (n, 4, 4), are rotations or poses."""
    flaw = {(3, 3): rotation_flaw, (4, 4): pose_flaw}.get(M.shape[-2:])
    return bool(flaw and np.isfinite(M).all() and flaw(M, RIGID) is None)


def millimetres(a: Array, b: Array) -> Array:
    """Return the distance of points, (..., 3) in metres, as (...) in millimetres."""
    return 1000.0 * np.linalg.norm(a - b, axis=-1)


def degrees(R_a: Array, R_b: Array) -> Array:
    """Return the angle between rotations, (..., 3, 3), as (...) in degrees.

    By atan2 from R's skew part and trace: exact near 0, where arccos is not.
    """
    R = R_a.mT @ R_b
    skew = R - R.mT
    sine = np.sqrt(np.sum(skew**2, axis=(-2, -1)) / 8.0)
    cosine = (np.trace(R, axis1=-2, axis2=-1) - 1.0) / 2.0
    return np.rad2deg(np.arctan2(sine, cosine))


def say_mm(mm: float) -> str:
    """Return a length in words; "0" for what rounding leaves."""
    return _say(mm, "mm", 1e-2)


def say_degrees(deg: float) -> str:
    """Return an angle in words; "0" for what rounding leaves."""
    return _say(deg, "deg", 1e-3)


def _say(value: float, unit: str, least: float) -> str:
    if value < least:
        return "0"
    digits = 0 if value >= 200 else 1 if value >= 10 else 2
    return f"{value:.{digits}f} {unit}"


def say_value(value: float, unit: str, scale: float, entry: str) -> str:
    """Return a number with its unit; "0" for what rounding leaves.

    Args:
        value: not negative.
        unit: "" for none.
        scale: what such a number is like.
        entry: what to add where it is one entry of many.
    """
    if value < MATCHES * scale:
        return "0"
    return f"{value:.3g}{f' {unit}' if unit else ''}{entry}"


def say_factor(factor: float) -> str:
    """Return a factor as people write it: "1000", "-1", "pi / 180"."""
    named = {np.pi / 180: "pi / 180", 180 / np.pi: "180 / pi", 2 * np.pi: "2 pi"}
    for value, name in named.items():
        if np.isclose(factor, value, rtol=1e-6):
            return name
    return f"{factor:.4g}"


def say_range(values: Array, say: Callable[[float], str]) -> str:
    """Return the least and the largest of values in words, once if they are alike."""
    least, most = say(float(values.min())), say(float(values.max()))
    return most if least == most else f"{least} to {most}"

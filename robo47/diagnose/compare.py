"""How far apart two sets of answers are, as a number and in words."""

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.diagnose.matrices import split, transposed

PASSED = 1e-8  # the lab's own line: the same to 8 decimals
CLOSE = 1e-4  # no mistake is this small; rounding is: pi/2 for 1.57079 gives 9.8e-5
MATCHES = 1e-5  # "this is the mistake": wide enough for a student's float32
RIGID = 1e-5  # how far R R^T may be from I before we call it no rotation


def difference(a: Array, b: Array) -> Array:
    """Return the largest difference of any entry per case, (n,); NaN counts as inf."""
    with np.errstate(invalid="ignore"):
        gap = np.where(a == b, 0.0, np.abs(a - b))  # inf equals inf
    return (
        np.nan_to_num(gap, nan=np.inf, posinf=np.inf).reshape(len(gap), -1).max(axis=1)
    )


def matches(a: Array, b: Array) -> bool:
    """Return whether a is b at every case, within rounding of b's largest entry."""
    finite = np.abs(b[np.isfinite(b)])
    return bool(difference(a, b).max() <= MATCHES * max(1.0, finite.max(initial=0.0)))


def rigid(M: Array) -> bool:
    """Return whether all of M, (n, 3, 3) or (n, 4, 4), are rotations or poses."""
    check = se3.is_rotation if M.shape[-1] == 3 else se3.is_pose
    return M.shape[-1] == M.shape[-2] and check(M, RIGID)


def millimetres(a: Array, b: Array) -> Array:
    """Return the distance of points, (..., 3) in metres, as (...) in millimetres."""
    return 1000.0 * np.linalg.norm(a - b, axis=-1)


def degrees(R_a: Array, R_b: Array) -> Array:
    """Return the angle between rotations, (..., 3, 3), as (...) in degrees.

    By atan2 from R's skew part and trace: exact near 0, where arccos is not.
    """
    R = transposed(R_a) @ R_b
    skew = R - transposed(R)
    sine = np.sqrt(np.sum(skew**2, axis=(-2, -1)) / 8.0)
    cosine = (np.trace(R, axis1=-2, axis2=-1) - 1.0) / 2.0
    return np.rad2deg(np.arctan2(sine, cosine))


def apart(a: Array, b: Array) -> str:
    """Return how far a is from b at worst, as people say it: "629 mm and 63.0 deg".

    Args:
        a: rotations (n, 3, 3), poses (n, 4, 4) or points (n, 2, 3).
        b: the same.
    """
    if a.shape[-1] == a.shape[-2] and rigid(a) and rigid(b):
        if a.shape[-1] == 3:
            return say_degrees(degrees(a, b).max())
        (R_a, t_a), (R_b, t_b) = split(a), split(b)
        parts = (
            say_mm(millimetres(t_a, t_b).max()),
            say_degrees(degrees(R_a, R_b).max()),
        )
        return " and ".join(p for p in parts if p != "0") or "0"
    if a.shape[-2:] == (2, 3) and np.isfinite(a).all():
        return say_mm(millimetres(a, b).max())
    worst = difference(a, b).max()
    return "0" if worst < MATCHES else f"{worst:.3g} in one entry"


def say_mm(mm: float) -> str:
    """Return a length in words; "0" for what rounding leaves."""
    return _say(mm, "mm", 1e-2)


def say_degrees(deg: float) -> str:
    """Return an angle in words; "0" for what rounding leaves."""
    return _say(deg, "deg", 1e-3)


def _say(value: float, unit: str, least: float) -> str:
    if value < least:
        return "0"
    return (
        f"{value:.0f} {unit}" if value >= 200 else f"{value:.{_digits(value)}f} {unit}"
    )


def _digits(value: float) -> int:
    return 1 if value >= 10 else 2

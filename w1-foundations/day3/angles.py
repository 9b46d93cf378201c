"""What is wrong with a `log_rotation` that no named mistake gives: where, and how."""

import numpy as np

from labkit.judge import Case, Finding
from labkit.judge.answers import difference
from robo47.checks import Array

BY_PI, BY_0 = 0.02, 0.02  # radians: "near pi" and "near 0" begin here
OFF = 1e-5
AMPLIFIED = 1e-13  # rounding errors, which a division by a small sine makes larger
NEXT_TO_NONE = 1e-8  # "close" begins here


def where_the_angle_fails(case: Case) -> Finding | None:
    """Return that the answer is right but for a sign, near 0, or near pi."""
    S, T = case.S, case.T
    angle = np.linalg.norm(T, axis=1)
    off = difference(S, T) > OFF
    by_pi = angle > np.pi - BY_PI
    by_0 = angle < BY_0
    if not off.any():
        return None
    if off[~by_pi & ~by_0].any():
        return _everywhere(S, T, off, angle)
    if not off[by_pi].any():
        return _zero_near_0(S, T, off) or Finding(
            "wrong-near-0", "Your rotation vector is wrong for an angle near 0."
        )
    some = off & by_pi
    i = np.flatnonzero(some)[0]
    says = f"For an angle {np.pi - angle[i]:.0e} rad below pi, your result is off by "
    says += f"{np.abs(S[i] - T[i]).max():.2g} rad."
    return _near_pi(S, T, some, says)


def _near_pi(S: Array, T: Array, some: np.ndarray, says: str) -> Finding:
    one_of_two = np.minimum(difference(S, T), difference(S, -T))
    if difference(S[some], -T[some]).max() < OFF:
        return Finding(
            "sign-near-pi",
            f"{says} The axis has the wrong sign. Near pi, R - R^T is small, but it "
            "still determines the sign.",
        )
    if one_of_two[some].max() > OFF and _alike(np.abs(S[some]), np.abs(T[some])):
        return Finding(
            "signs-near-pi",
            f"{says} The entries are correct except for their signs, which the "
            "diagonal entries of R do not determine. Which entries of R + R^T "
            "determine the relative signs?",
        )
    if found := _set_to_pi(S, T, some):
        return found
    below = np.maximum(np.pi - np.linalg.norm(T[some], axis=1), 1e-300)
    why = "Look at the part of your function for angles near pi."
    if np.all(difference(S[some], T[some]) < AMPLIFIED / below):
        why = "Near pi, R - R^T is nearly 0. Does your code divide R - R^T by the "
        why += "sine of the angle? This division amplifies the rounding errors."
    return Finding("wrong-near-pi", f"{says} {why}")


def _alike(a: Array, b: Array) -> bool:
    return bool(difference(a, b).max() < OFF)


def _set_to_pi(S: Array, T: Array, some: np.ndarray) -> Finding | None:
    length = np.linalg.norm(T[some], axis=1, keepdims=True)
    if difference(S[some], np.pi * T[some] / length).max() > 1e-9:
        return None
    least = np.pi - float(length.min())
    return Finding(
        "pi-for-the-angle",
        f"Your angle is pi, but it should be {least:.1e} rad smaller. Near pi, the "
        "sine is small but not 0, so atan2 still gives the correct angle.",
    )


def _zero_near_0(S: Array, T: Array, some: np.ndarray) -> Finding | None:
    if S[some].any():
        return None
    angle = float(np.linalg.norm(T[some], axis=1).max())
    return Finding(
        "zero-for-small-angles",
        f"Your result is 0 for a rotation by {angle:.0e} rad. Either a threshold is "
        "too large, or the cosine of the angle is rounded to 1. Which formula for "
        "small angles needs no division?",
    )


def _everywhere(
    S: Array, T: Array, off: np.ndarray, angle: np.ndarray
) -> Finding | None:
    """Return that it is right but for the sign, or for whole turns."""
    k = off.sum()
    n = len(off)
    if difference(S[off], -T[off]).max() < OFF:
        return Finding(
            "sign-of-the-axis",
            f"Your result has the wrong sign for {k} of {n} rotations. An axis has "
            f"two directions, and R - R^T determines the correct direction.",
        )
    other_way = T[off] * (1.0 - 2.0 * np.pi / angle[off, None])
    if difference(S[off], other_way).max() < OFF:
        return Finding(
            "angle-over-pi",
            f"Your angle is more than pi for {k} of {n} rotations. A rotation about "
            "the opposite axis has a smaller angle. For a quaternion, use the sign "
            "with w > 0.",
        )
    least = angle[off].min()
    if angle[angle < least].max(initial=0.0) < 2.0:
        return None
    return Finding(
        "large-angles",
        "In the tests, your result is wrong only for angles of "
        f"about {np.degrees(least):.0f} degrees or more, by up to "
        f"{difference(S, T).max():.3g} rad. Look at the part of your function for "
        "angles near pi.",
    )


def where_the_digits_go(case: Case) -> Finding | None:
    """Return that a nearly right answer is 0 near 0, is pi near pi, or an arccosine."""
    S, T = case.S, case.T
    off = difference(S, T) > NEXT_TO_NONE
    angle = np.linalg.norm(T, axis=1)
    by_0 = angle < BY_0
    by_pi = angle > np.pi - BY_PI
    if off[~by_0 & ~by_pi].any():
        return None
    if not off[by_pi].any() and (found := _zero_near_0(S, T, off)):
        return found
    if not off[by_0].any() and (found := _set_to_pi(S, T, off)):
        return found
    return _as_an_arccosine(S, T, off)


def _as_an_arccosine(S: Array, T: Array, off: np.ndarray) -> Finding | None:
    """Return that the angles, and they alone, have half of their digits."""
    axis = T[off] / np.linalg.norm(T[off], axis=1, keepdims=True)
    along = np.sum(S[off] * axis, axis=1, keepdims=True) * axis
    apart = difference(S, T).max()
    if difference(S[off], along).max() > 1e-12 or apart > 1e-7:
        return None
    return Finding(
        "arccosine",
        f"Your result is close, but the angle is off by {apart:.1e} near 0 or pi. Near "
        "these angles, an arccosine loses half of the digits. Which function uses both "
        "the sine and the cosine?",
    )

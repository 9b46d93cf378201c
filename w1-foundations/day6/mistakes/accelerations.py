"""Mistakes in task 6.2 `site_bias(J_space, qd, p)`."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array
from robo47.screws import ad

from . import named


def bias(
    J: Array,
    qd: Array,
    p: Array,
    *,
    rate: Callable[[Array, Array], Array] = lambda V, S: ad(V) @ S,
    turn: float = 1.0,
    centre: float = 1.0,
    move: float = 1.0,
) -> Array:
    """Return the hand's bias; the right one unless told otherwise."""
    parts = (J * qd).T
    V = np.cumsum(parts, axis=0)
    A = sum(rate(v, s) for v, s in zip(V, parts, strict=True))
    total = parts.sum(axis=0)
    omega, alpha = total[:3], A[:3]
    velocity = move * total[3:] + centre * np.cross(omega, p)
    linear = A[3:] + turn * np.cross(alpha, p) + np.cross(omega, velocity)
    return np.append(alpha, linear)


def _own_bracket(V: Array, S: Array) -> Array:
    """ad(V)^T S, which is for wrenches."""
    return ad(V).T @ S


def _without_lower_block(V: Array, S: Array) -> Array:
    B = ad(V).copy()
    B[3:, :3] = 0.0
    return B @ S


def _rate_only(J: Array, qd: Array, p: Array) -> Array:
    parts = (J * qd).T
    V = np.cumsum(parts, axis=0)
    return (ad(V) @ parts[..., None])[..., 0].sum(axis=0)


def _no_joint_speed(J: Array, qd: Array, p: Array) -> Array:
    """The screws are not multiplied by their own joint's speed."""
    V = np.cumsum((J * qd).T, axis=0)
    A = (ad(V) @ J.T[..., None])[..., 0].sum(axis=0)
    omega = V[-1, :3]
    velocity = V[-1, 3:] + np.cross(omega, p)
    linear = A[3:] + np.cross(A[:3], p) + np.cross(omega, velocity)
    return np.append(A[:3], linear)


def _coriolis(J: Array, qd: Array) -> Array:
    return np.cross((J @ qd)[:3], (J @ qd)[3:])


def _nothing(V: Array, S: Array) -> Array:
    return np.zeros(6)


SITE_BIAS = [
    named(
        "of-the-origin",
        "this is the twist's rate about the world's origin, the sum of ad(V) S qd; the "
        "acceleration of the point p is another thing: the linear half is to be "
        "converted",
        _rate_only,
        "the sum alone",
    ),
    named(
        "no-centripetal",
        "the part omega x (velocity of p) is missing: a point on a circle accelerates "
        "towards its centre though the speed is steady",
        lambda J, qd, p: (
            _rate_only(J, qd, p)
            + np.append(np.zeros(3), np.cross(_rate_only(J, qd, p)[:3], p))
        ),
        "the right one without it",
    ),
    named(
        "no-alpha-cross-p",
        "the angular acceleration is not converted to the point: alpha x p is missing",
        lambda J, qd, p: bias(J, qd, p, turn=0.0),
        "the right one without it",
    ),
    named(
        "velocity-of-origin",
        "omega is crossed with v, the velocity of the point at the world's origin; p "
        "itself moves at v + omega x p",
        lambda J, qd, p: bias(J, qd, p, centre=0.0),
        "the right one with v there",
    ),
    named(
        "v-forgotten",
        "the velocity of p is taken to be omega x p alone; v belongs to it",
        lambda J, qd, p: bias(J, qd, p, move=0.0),
        "the right one without v",
    ),
    named(
        "p-sign",
        "the cross products with p have their factors swapped: p x omega is minus "
        "omega x p",
        lambda J, qd, p: bias(J, qd, -p),
        "the right one with -p",
    ),
    named(
        "ad-swapped",
        "V and S have changed places, or the twists are summed from the tip: ad(S) V "
        "is minus ad(V) S, and a joint is carried by those before it",
        lambda J, qd, p: bias(J, qd, p, rate=lambda V, S: ad(S) @ V),
        "the right one with ad(S) V",
    ),
    named(
        "ad-transposed",
        "ad(V) is transposed: that one is for wrenches, screws take it as it is",
        lambda J, qd, p: bias(J, qd, p, rate=_own_bracket),
        "the right one with ad(V)^T",
    ),
    named(
        "ad-half",
        "ad(V) lacks its lower left block [v]",
        lambda J, qd, p: bias(J, qd, p, rate=_without_lower_block),
        "the right one without it",
    ),
    named(
        "twist-of-the-hand",
        "every joint is taken to ride on the hand; joint i rides on link i, which only "
        "the joints up to it move; ad(V) V is 0, so nothing is left of the sum",
        lambda J, qd, p: bias(J, qd, p, rate=_nothing),
        "the right one without the sum of ad(V) S qd",
    ),
    named(
        "last-joint-left-out",
        "the last joint is left out: range(6) ends with joint6",
        lambda J, qd, p: bias(J[:, :6], qd[:6], p),
        "the right one of six joints",
    ),
    named(
        "coriolis-twice",
        "omega x v counts twice: ad(V) S has it already, and 2 omega x v belongs to "
        "accelerations measured in the moving frame",
        lambda J, qd, p: bias(J, qd, p) + np.append(np.zeros(3), _coriolis(J, qd)),
        "the right one with another omega x v",
    ),
    named(
        "qd-once",
        "the screws are not multiplied by their own joint's speed: the sum is of "
        "ad(V) S, and qd is missing",
        _no_joint_speed,
        "the right one without that qd",
    ),
    named(
        "negative",
        "every sign is wrong: this is what has to be taken away from acc, not the "
        "acceleration itself",
        lambda J, qd, p: -bias(J, qd, p),
        "minus the right one",
    ),
]

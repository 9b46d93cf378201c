"""Mistakes in tasks 6.1 `task_inertia(J, M)` and 6.2 `site_bias(J_space, qd, p)`."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array
from robo47.screws import ad

from . import named

ARMATURE = 0.1  # kg m2, of every joint of the Panda


def inertia(J: Array, M: Array) -> Array:
    """Return Lambda, right."""
    return np.linalg.inv(J @ np.linalg.solve(M, J.T))


SWAP = [3, 4, 5, 0, 1, 2]
TASK_INERTIA = [
    named(
        "inverse-forgotten",
        "this is the inverse of Lambda: it says how far a push accelerates the hand, "
        "not how heavy the hand is",
        lambda J, M: J @ np.linalg.solve(M, J.T),
        "J M^-1 J^T",
    ),
    named(
        "M-not-inverted",
        "M stands between J and J^T as it is; a push meets the joints' torques first, "
        "and torques make accelerations through M^-1",
        lambda J, M: J @ M @ J.T,
        "J M J^T",
    ),
    named(
        "M-not-inverted",
        "M stands between J and J^T as it is, and the product is inverted; M has to be "
        "inverted too",
        lambda J, M: np.linalg.inv(J @ M @ J.T),
        "(J M J^T)^-1",
    ),
    named(
        "pinv-both-sides",
        "pinv(J)^T M pinv(J) is right for an arm of six joints; with seven the elbow "
        "is free to give way, and the hand is lighter",
        lambda J, M: np.linalg.pinv(J).T @ M @ np.linalg.pinv(J),
        "pinv(J)^T M pinv(J)",
    ),
    named(
        "M-left-out",
        "M is not in it: (J J^T)^-1 knows where the joints are, not what they carry",
        lambda J, M: np.linalg.inv(J @ J.T),
        "(J J^T)^-1",
    ),
    named(
        "armature-left-out",
        "the armature is taken out of M; the rotors turn with the joints, so somebody "
        "who pushes the hand feels them",
        lambda J, M: inertia(J, M - ARMATURE * np.eye(7)),
        "Lambda of M - 0.1 I",
    ),
    named(
        "rows-swapped",
        "the rows of J are put in the order (v; omega); here the angular three come "
        "first, in J as in every wrench",
        lambda J, M: inertia(J[SWAP], M),
        "Lambda of J with its halves swapped",
    ),
    named(
        "diagonal-of-M",
        "only the diagonal of M is used; the joints pull at each other",
        lambda J, M: inertia(J, np.diag(np.diag(M))),
        "Lambda of M's diagonal",
    ),
    named(
        "diagonal-inverted",
        "only the diagonal of J M^-1 J^T is inverted; the six directions are coupled",
        lambda J, M: np.diag(1.0 / np.diag(J @ np.linalg.solve(M, J.T))),
        "that diagonal",
    ),
    named(
        "entries-inverted",
        "1 / A inverts every entry; the inverse of a matrix is another thing",
        lambda J, M: 1.0 / (J @ np.linalg.solve(M, J.T)),
        "1 / (J M^-1 J^T)",
    ),
]


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
        "the joints up to it move. (ad(V) V is 0, so nothing is left of the sum)",
        lambda J, qd, p: bias(J, qd, p, rate=_nothing),
        "the right one without the sum of ad(V) S qd",
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

"""Mistakes in tasks 3.1, 3.2 and 3.9: `space_jacobian`, `site_jacobian`, `body_jacobian`.

`redo` takes screws (n, 7, 6) and q (n, 7), or J_space (n, 6, 7) with p (n, 3) or
T (n, 4, 4).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from robo47 import jacobian
from robo47.checks import Array
from robo47.diagnose.matrices import rigid_inverse, split, transposed
from robo47.diagnose.mistake import Mistake
from robo47.screws import adjoint, exp_screw, skew

Function = Callable[..., Any]


def space(S: Array, q: Array, carry: Function = adjoint, upto: Function = int) -> Array:
    """Return J_space, (n, 6, 7).

    Args:
        S: screws, (n, 7, 6).
        q: joint angles, (n, 7).
        carry: in place of the adjoint of the motion so far.
        upto: how many joints have moved, from the joint's index.
    """
    steps = [exp_screw(S[:, i], q[:, i]) for i in range(7)]
    moved = [np.broadcast_to(np.eye(4), (len(q), 4, 4))]
    for step in steps:
        moved.append(moved[-1] @ step)
    columns = [carry(moved[max(upto(i), 0)]) @ S[:, i, :, None] for i in range(7)]
    return np.concatenate(columns, axis=-1)


def _last_only(S: Array, q: Array, on_left: bool = False) -> Array:
    """Return the columns carried by the joint before alone, or by a reversed product."""
    T, columns = np.broadcast_to(np.eye(4), (len(q), 4, 4)), []
    for i in range(7):
        columns.append(adjoint(T) @ S[:, i, :, None])
        step = exp_screw(S[:, i], q[:, i])
        T = step @ T if on_left else step
    return np.concatenate(columns, axis=-1)


def _blocks(lower: Function, upper: Function | None = None) -> Function:
    """Return an adjoint with other blocks off the diagonal, made of R and p."""

    def carry(T: Array) -> Array:
        R, p = split(T)
        out = np.zeros((len(T), 6, 6))
        out[:, :3, :3] = out[:, 3:, 3:] = R
        out[:, 3:, :3] = lower(R, skew(p))
        out[:, :3, 3:] = upper(R, skew(p)) if upper else 0.0
        return out

    return carry


def _none(R: Array, K: Array) -> Array:
    return np.zeros_like(R)


def _moves_only(T: Array) -> Array:
    out = np.array(np.broadcast_to(np.eye(6), (len(T), 6, 6)))
    out[:, 3:, :3] = skew(T[:, :3, 3])
    return out


def _in_the_adjoint(carry: Function) -> Function:
    return lambda S, q: space(S, q, carry)


SPACE = [
    Mistake(
        "screws-constant",
        "the columns are the screws at q = 0; the joints before a joint have moved its "
        "screw",
        lambda S, q: transposed(S),
        "the screws as columns",
    ),
    Mistake(
        "last-joint-only",
        "each screw is moved by the one joint before it; all joints before it move it",
        _last_only,
        "the Jacobian with one exponential per column",
    ),
    Mistake(
        "product-reversed",
        "the exponentials are multiplied in the reverse order: the first joint's stands "
        "on the left",
        lambda S, q: _last_only(S, q, on_left=True),
        "the Jacobian with the reversed product",
    ),
    Mistake(
        "one-joint-late",
        "each screw lacks the motion of the joint right before it: the product is used "
        "before that joint is in it",
        lambda S, q: space(S, q, upto=lambda i: i - 1),
        "the Jacobian one joint late",
    ),
    Mistake(
        "moved-by-the-next",
        "each screw is moved by the joint behind it too, which it does not feel",
        lambda S, q: space(S, q, upto=lambda i: min(i + 2, 7)),
        "the Jacobian one joint too far",
    ),
    Mistake(
        "moved-by-all",
        "every screw is moved by all seven joints; only those before it carry it",
        lambda S, q: space(S, q, upto=lambda i: 7),
        "the Jacobian with the whole product",
    ),
    Mistake(
        "adjoint-of-the-inverse",
        "the screws are carried the other way: this is Ad of the inverse",
        _in_the_adjoint(lambda T: adjoint(rigid_inverse(T))),
        "the Jacobian with the inverse",
    ),
    Mistake(
        "bracket-top-right",
        "in the adjoint, [p] R stands top right; with (omega; v) it stands bottom left",
        _in_the_adjoint(_blocks(_none, lambda R, K: K @ R)),
        "the Jacobian with that adjoint",
    ),
    Mistake(
        "bracket-after-R",
        "in the adjoint, R [p] stands where [p] R belongs",
        _in_the_adjoint(_blocks(lambda R, K: R @ K)),
        "the Jacobian with that adjoint",
    ),
    Mistake(
        "rotation-only",
        "the screws are only rotated; where the joints have moved to is left out ([p] R "
        "is missing in the adjoint)",
        _in_the_adjoint(_blocks(_none)),
        "the Jacobian with R alone",
    ),
    Mistake(
        "translation-only",
        "the screws are only translated; the rotation R is left out of the adjoint",
        _in_the_adjoint(_moves_only),
        "the Jacobian with I for R",
    ),
    Mistake(
        "all-backwards",
        "every joint turns the other way, by -q",
        lambda S, q: space(S, -q),
        "the Jacobian at -q",
    ),
    Mistake(
        "degrees",
        "q comes in radians, and is used as degrees",
        lambda S, q: space(S, np.rad2deg(q)),
        "the Jacobian at 180 / pi times q",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "q is in radians already, and is converted from degrees once more",
        lambda S, q: space(S, np.deg2rad(q)),
        "the Jacobian at pi / 180 times q",
    ),
    Mistake(
        "columns-reversed",
        "the columns are in the reverse order: joint 1's comes first",
        lambda S, q: space(S, q)[..., ::-1],
        "the right one with its columns reversed",
    ),
]


def site(J: Array, p: Array, sign: float = 1.0, v: float = 1.0) -> Array:
    """Return J with v replaced by v + sign omega x p, (n, 6, 7)."""
    cross = np.cross(J[:, :3], p[:, :, None], axis=1)
    return np.concatenate([J[:, :3], v * J[:, 3:] + sign * cross], axis=1)


SITE = [
    Mistake(
        "space-for-site",
        "this is J_space still: its v is the velocity at the world's origin, not at p",
        lambda J, p: J,
        "J_space itself",
    ),
    Mistake(
        "cross-sign",
        "the sign of the cross product is wrong: a spin about z takes (1, 0, 0) to +y",
        lambda J, p: site(J, p, -1.0),
        "the Jacobian with v - omega x p",
    ),
    Mistake(
        "v-dropped",
        "v is only omega x p; the v that J_space has is left out",
        lambda J, p: site(J, p, 1.0, 0.0),
        "the Jacobian with omega x p alone",
    ),
    Mistake(
        "halves-read-as-v-omega",
        "the upper rows of J_space are taken for v, and the lower ones for omega",
        lambda J, p: np.roll(site(np.roll(J, 3, axis=1), p), 3, axis=1),
        "the Jacobian with the halves read the other way",
    ),
    Mistake(
        "v-cross-p",
        "v x p is added, where omega x p belongs",
        lambda J, p: np.concatenate(
            [J[:, :3], J[:, 3:] + np.cross(J[:, 3:], p[:, :, None], axis=1)], axis=1
        ),
        "the Jacobian with v + v x p",
    ),
    Mistake(
        "omega-changed",
        "omega is changed by v x p; all points of a body have the same omega",
        lambda J, p: np.concatenate(
            [J[:, :3] + np.cross(J[:, 3:], p[:, :, None], axis=1), J[:, 3:]], axis=1
        ),
        "the Jacobian with the cross product above",
    ),
]


def _turned(J: Array, T: Array) -> Array:
    """Return both halves in the hand's axes."""
    back = transposed(T[:, :3, :3])
    return np.concatenate([back @ J[:, :3], back @ J[:, 3:]], axis=1)


BODY = [
    Mistake(
        "adjoint-of-T",
        "T leads from the hand to the world; here the twists are to be taken back",
        lambda J, T: adjoint(T) @ J,
        "the Jacobian with Ad(T)",
    ),
    Mistake(
        "space-for-body",
        "this is J_space still, as the world sees it",
        lambda J, T: J,
        "J_space itself",
    ),
    Mistake(
        "site-for-body",
        "this is J_site: the velocity of the right point, but in the world's axes",
        lambda J, T: jacobian.site_jacobian(J, T[:, :3, 3]),
        "J_site",
    ),
    Mistake(
        "rotation-only",
        "J_space is turned into the hand's axes, but v is still that of the point at "
        "the world's origin",
        _turned,
        "J_space in the hand's axes",
    ),
    Mistake(
        "transposed-adjoint",
        "this is Ad(T) transposed; the inverse of an adjoint is not its transpose",
        lambda J, T: transposed(adjoint(T)) @ J,
        "the Jacobian with that transpose",
    ),
]

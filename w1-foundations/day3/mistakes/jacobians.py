"""Mistakes in task 3.1: `space_jacobian(screws, q)`.

`redo` takes screws (n, 7, 6) and q (n, 7).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import rigid_inverse, split, transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array
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
    """Return the columns carried by one joint, or by a reversed product."""
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
        "the exponentials are multiplied in the reverse order: the first joint's "
        "stands on the left",
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
        "the screws are only rotated; where the joints have moved to is left out ([p] "
        "R is missing in the adjoint)",
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

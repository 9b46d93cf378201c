"""Mistakes in a product of exponentials, 2.6 and 2.8, made in q or in M before it.

A mistake in one joint only is not listed here: `places` finds which one.
"""

import numpy as np

from labkit.judge import Pose
from labkit.judge.argument_mistakes import Change
from labkit.judge.row import Row
from robo47 import se3

from . import places
from .exp_screw import NOT_OF_AN_ARM, motion


def space(screws, M, q):
    """Return e^[S1] q1 ... e^[S7] q7 M, whatever the screws are."""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ motion(S, theta)
    return T @ M


def body(screws, M, q):
    """Return M e^[B1] q1 ... e^[B7] q7, whatever the screws are."""
    return M @ space(screws, np.eye(4), q)


def _with_joints(q, which):
    """Return q with 0 for all other joints: their exponentials are I then."""
    out = np.zeros_like(q)
    out[which] = q[which]
    return out


NEIGHBOUR = "each joint is given its neighbour's angle: q is indexed one off"

IN_Q = (
    Change(
        "joints-left-out",
        "nothing moves: whatever q is, your pose is M, the one at q = 0",
        np.zeros_like,
        "the pose at q = 0",
    ),
    Change(
        "all-backwards",
        "every joint turns the other way, by -q",
        np.negative,
        "the pose at -q",
    ),
    Change(
        "sign-of-q-lost",
        "the sign of q is lost: a negative angle turns the positive way",
        np.abs,
        "the pose at |q|",
    ),
    Change(
        "negative-angles-left-out",
        "joints with a negative angle do not move",
        lambda q: np.maximum(q, 0.0),
        "the pose with 0 for each of them",
    ),
    Change(
        "angles-added-up",
        "each joint is given the sum of all angles up to its own; its exponential "
        "needs its own alone, since the product carries the others",
        np.cumsum,
        "the pose with those sums",
    ),
    Change(
        "radians-taken-for-degrees",
        "q is in radians already, and is converted from degrees once more",
        np.deg2rad,
        "the pose at pi / 180 times q",
    ),
    Change(
        "degrees",
        "q comes in radians, and is used as degrees",
        np.rad2deg,
        "the pose at 180 / pi times q",
    ),
    Change(
        "off-by-one-joint",
        NEIGHBOUR,
        lambda q: np.roll(q, 1),
        "the pose with q shifted by one",
    ),
    Change(
        "off-by-one-joint",
        NEIGHBOUR,
        lambda q: np.roll(q, -1),
        "the pose with q shifted by one",
    ),
    Change(
        "first-angle-for-all",
        "every joint is given the first angle, q[0]: the index never moves on",
        lambda q: np.full(7, q[0]),
        "the pose with q[0] everywhere",
    ),
    Change(
        "q-backwards",
        "q is read backwards: joint1 gets the last angle",
        lambda q: q[::-1],
        "the pose with q backwards",
    ),
    Change(
        "last-joint-missing",
        "the last joint does not count: the loop ends one too early",
        lambda q: _with_joints(q, slice(6)),
        "the product without it",
    ),
    Change(
        "first-joint-missing",
        "the first joint does not count: the loop starts one too late",
        lambda q: _with_joints(q, slice(1, 7)),
        "the product without it",
    ),
    Change(
        "first-joint-only",
        "only the first joint counts (does return stand inside the loop?)",
        lambda q: _with_joints(q, 0),
        "the product with joint1 alone",
    ),
    Change(
        "last-joint-only",
        "only the last joint counts: what the others do is overwritten",
        lambda q: _with_joints(q, 6),
        "the product with joint7 alone",
    ),
)

IN_M = (
    Change(
        "M-forgotten",
        "M is missing: the motions are right, but they have to act on where the hand "
        "is at q = 0",
        lambda M: np.eye(4),
        "the product without M",
    ),
    Change(
        "M-inverted",
        "M is inverted; it maps hand coordinates to the world as it is",
        se3.inverse,
        "the product with the inverse of M",
    ),
    Change(
        "M-turned-back",
        "M's rotation is transposed",
        lambda M: se3.make_T(M[:3, :3].T, M[:3, 3]),
        "the product with that M",
        hidden="the Panda's M is symmetric",
    ),
    Change(
        "M-twice",
        "M is there twice, side by side",
        lambda M: M @ M,
        "the product with M M for M",
    ),
    Change(
        "M-rotation-missing",
        "M's rotation is missing; only its translation is there",
        lambda M: se3.make_T(np.eye(3), M[:3, 3]),
        "the product without it",
    ),
)

# A joint's exponential by a wrong angle is the product at a wrong q.
ALIKE = ({"turns-backwards", "all-backwards"}, {"degrees-into-cos", "degrees"})
HIDDEN = {"pair-of-signs": "at q = 0 the Panda has no axis with an x"}


def product_row(fk, inputs):
    """Return the row of a product.

    Args:
        fk: the library's, which is slow for one arm and quick for many.
        inputs: generator of screws, M and q.
    """
    row = Row(
        Pose(wrong_way="maps the world to the end effector"),
        truth=lambda S, M, q: fk(S[None], M, q[None])[0],
        alike=ALIKE,
        probe=places.alone(inputs),
        unnamed=places.unnamed,
        measured=places.measured,
    )
    row.inputs(inputs)
    return row


EITHER = []  # mistakes that are made in `space` and in `body`, the form, alike


def either(code):
    """Take one of them; its words are as below `Row.wrong`."""
    EITHER.append(code)
    return code


def with_M(form, T, M):
    """Return T M or M T, as the form has it."""
    return T @ M if form is space else M @ T


def by_entries(form, screws, M, q, T):
    """Return the product with the exponentials multiplied entry by entry, T first."""
    for S, theta in zip(screws, q, strict=True):
        T = T * motion(S, theta)
    return with_M(form, T, M)


@either
def product_reversed(form, screws, M, q):
    """the exponentials stand in the reverse order: the joint nearest to the base
    belongs on the left => the product in reverse"""
    return form(screws[::-1], M, q[::-1])


@either
def M_twice(form, screws, M, q):
    """M stands on both sides of the exponentials => the product with M twice"""
    return M @ space(screws, M, q)


@either
def M_in_the_loop(form, screws, M, q):
    """M is in the loop, beside every exponential: at q = 0 your pose is M seven times,
    not M => that product"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ with_M(form, motion(S, theta), M)
    return T


@either
def exponentials_summed(form, screws, M, q):
    """the twists are added up and exponentiated together; e^A e^B is e^(A + B) only
    where the order does not matter => the exponential of the sum"""
    V = q @ screws
    size = np.linalg.norm(V[:3]) or 1.0
    return with_M(form, motion(V / size, size), M)


@either
def multiplied_by_entries(form, screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries"""
    return by_entries(form, screws, M, q, np.ones((4, 4)))


@either
def multiplied_by_entries(form, screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries, from the identity on"""
    return by_entries(form, screws, M, q, np.eye(4))


def either_form(row, form):
    """Take the mistakes that both forms have: in the product, in q, M or one factor."""
    for code in EITHER:

        def way(screws, M, q, code=code):
            return code(form, screws, M, q)

        way.__name__, way.__doc__ = code.__name__, code.__doc__
        row.wrong(way)
    for one in IN_Q:
        row.wrong(one.slug, one.says, one.redone)(
            lambda screws, M, q, change=one.change: form(screws, M, change(q))
        )
    for one in IN_M:
        row.wrong(one.slug, one.says, one.redone, one.hidden)(
            lambda screws, M, q, change=one.change: form(screws, change(M), q)
        )
    row.reached_by(
        "exp_screw", "in every exponential, ", but=NOT_OF_AN_ARM, hidden=HIDDEN
    )

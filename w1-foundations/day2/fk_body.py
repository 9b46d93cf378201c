"""2.8 `fk_body(body_screws, M, q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose
from labkit.judge.row import Row
from robo47 import screws

from . import places
from .arms import arms
from .exp_screw import NOT_OF_AN_ARM, motion
from .products import ALIKE, HIDDEN, IN_M, IN_Q, body, quick, space


def seen_by_the_hand(rng):
    """Return the arms of `fk_space`, their screws told in the hand's frame."""
    return [(screws.body_screws(S, M), M, q) for S, M, q in arms(rng)]


row = Row(
    Pose(wrong_way="maps the world to the end effector"),
    truth=quick(screws.fk_body),
    alike=ALIKE,
    probe=places.alone(seen_by_the_hand),
    unnamed=places.unnamed,
    measured=places.measured,
)
row.inputs(seen_by_the_hand)


@row.wrong
def M_last(body_screws, M, q):
    """M stands on the right of the exponentials (or the screws are converted, and they
    are the hand's already); motions told in the hand's frame follow M => the product
    with M last"""
    return space(body_screws, M, q)


@row.wrong
def motions_on_the_left(body_screws, M, q):
    """each new exponential is put on the left of what is there; these screws are told
    in the hand's frame, so it goes on the right => the product so put together"""
    return space(body_screws[::-1], M, q[::-1])


@row.wrong
def product_reversed(body_screws, M, q):
    """the exponentials stand in the reverse order: the joint nearest to the base
    belongs on the left => the product in reverse"""
    return body(body_screws[::-1], M, q[::-1])


@row.wrong
def M_twice(body_screws, M, q):
    """M stands on both sides of the exponentials => the product with M twice"""
    return M @ space(body_screws, M, q)


@row.wrong
def M_in_the_loop(body_screws, M, q):
    """M is in the loop, beside every exponential: at q = 0 your pose is M seven times,
    not M => that product"""
    T = np.eye(4)
    for B, theta in zip(body_screws, q, strict=True):
        T = T @ M @ motion(B, theta)
    return T


@row.wrong
def exponentials_summed(body_screws, M, q):
    """the twists are added up and exponentiated together; e^A e^B is e^(A + B) only
    where the order does not matter => the exponential of the sum"""
    V = q @ body_screws
    size = np.linalg.norm(V[:3]) or 1.0
    return M @ motion(V / size, size)


@row.wrong
def multiplied_by_entries(body_screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries"""
    T = np.ones((4, 4))
    for B, theta in zip(body_screws, q, strict=True):
        T = T * motion(B, theta)
    return M @ T


@row.wrong
def multiplied_by_entries(body_screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries, from the identity on"""
    T = np.eye(4)
    for B, theta in zip(body_screws, q, strict=True):
        T = T * motion(B, theta)
    return M @ T


for one in IN_Q:

    @row.wrong(one.slug, one.says, one.redone)
    def _(body_screws, M, q, change=one.change):
        return body(body_screws, M, change(q))


for one in IN_M:

    @row.wrong(one.slug, one.says, one.redone, one.hidden)
    def _(body_screws, M, q, change=one.change):
        return body(body_screws, change(M), q)


row.reached_by("exp_screw", "in every exponential, ", but=NOT_OF_AN_ARM, hidden=HIDDEN)


@row.right  # M e^B = e^(M B M^-1) M: the world's form of each factor.
def _(body_screws, M, q):
    T = np.eye(4)
    for B, theta in zip(body_screws, q, strict=True):
        T = T @ M @ motion(B, theta) @ np.linalg.inv(M)
    return T @ M


@row.right  # By recursion.
def _recursive(body_screws, M, q):
    if len(q) == 0:
        return M.copy()
    return _recursive(body_screws[:-1], M, q[:-1]) @ motion(body_screws[-1], q[-1])

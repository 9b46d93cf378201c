"""2.6 `fk_space(screws, M, q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose
from labkit.judge.row import Row
from robo47 import screws, se3
from robo47.screws import adjoint

from . import places
from .arms import arms
from .exp_screw import NOT_OF_AN_ARM, motion
from .products import ALIKE, HIDDEN, IN_M, IN_Q, body, quick, space

row = Row(
    Pose(wrong_way="maps the world to the end effector"),
    truth=quick(screws.fk_space),
    alike=ALIKE,
    probe=places.alone(arms),
    unnamed=places.unnamed,
    measured=places.measured,
)
row.inputs(arms)


@row.wrong
def M_first(screws, M, q):
    """M stands on the left of the exponentials; the screws are told in the world, so
    their motions act on M from the left => the product with M first"""
    return body(screws, M, q)


@row.wrong
def product_reversed(screws, M, q):
    """the exponentials stand in the reverse order: the joint nearest to the base
    belongs on the left => the product in reverse"""
    return space(screws[::-1], M, q[::-1])


@row.wrong
def M_twice(screws, M, q):
    """M stands on both sides of the exponentials => the product with M twice"""
    return M @ space(screws, M, q)


@row.wrong
def M_in_the_loop(screws, M, q):
    """M is in the loop, beside every exponential: at q = 0 your pose is M seven times,
    not M => that product"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ motion(S, theta) @ M
    return T


@row.wrong
def exponentials_summed(screws, M, q):
    """the twists are added up and exponentiated together; e^A e^B is e^(A + B) only
    where the order does not matter => the exponential of the sum"""
    V = q @ screws
    size = np.linalg.norm(V[:3]) or 1.0
    return motion(V / size, size) @ M


@row.wrong
def multiplied_by_entries(screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries"""
    T = np.ones((4, 4))
    for S, theta in zip(screws, q, strict=True):
        T = T * motion(S, theta)
    return T @ M


@row.wrong
def multiplied_by_entries(screws, M, q):
    """the exponentials are multiplied entry by entry, not as matrices => the product by
    entries, from the identity on"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T * motion(S, theta)
    return T @ M


@row.wrong
def M_only_added(screws, M, q):
    """M's translation is added and its rotation is missing; the pose has to be
    multiplied by all of M => the product with t of M added"""
    T = space(screws, np.eye(4), q)
    T[:3, 3] += M[:3, 3]
    return T


@row.wrong
def screws_moved_along(screws, M, q):
    """each screw is carried along by the joints before it; the product does that
    already, so the screws of q = 0 are all it needs => that product"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ motion(adjoint(T) @ S, theta)
    return T @ M


@row.wrong
def space_screws_in_body_form(screws, M, q):
    """the screws are taken to the hand's frame, but the product is still that of the
    world's => that product"""
    return space(screws @ adjoint(se3.inverse(M)).T, M, q)


for one in IN_Q:

    @row.wrong(one.slug, one.says, one.redone)
    def _(screws, M, q, change=one.change):
        return space(screws, M, change(q))


for one in IN_M:

    @row.wrong(one.slug, one.says, one.redone, one.hidden)
    def _(screws, M, q, change=one.change):
        return space(screws, change(M), q)


row.reached_by("exp_screw", "in every exponential, ", but=NOT_OF_AN_ARM, hidden=HIDDEN)


@row.right  # From the hand inwards: each joint carries what is outside it.
def _(screws, M, q):
    T = M
    for S, theta in zip(screws[::-1], q[::-1], strict=True):
        T = motion(S, theta) @ T
    return T


@row.right  # Every screw carried to where it is now, from the tip of the product.
def _(screws, M, q):
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = motion(adjoint(T) @ S, theta) @ T
    return T @ M

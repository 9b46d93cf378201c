"""2.5 `joint_screws(T_zero)`: its questions and its mistakes."""

from itertools import accumulate

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row
from robo47 import se3
from robo47.screws import joint_screws, screw_axis

from .arms import SCREWS, the_panda
from .halves import which_half

row = Row(SCREWS, unnamed=which_half)


@row.inputs
def _(rng):
    yield (the_panda()[2],)
    for _ in range(7):
        yield (draw.poses(rng, 7),)


def through(points, T_zero):
    """Return the screws with other points."""
    return screw_axis(T_zero[:, :3, 2], points)


def local(T_zero):
    """Return each link's pose on the one before; the first one's on the world."""
    return se3.inverse(np.array([np.eye(4), *T_zero[:-1]])) @ T_zero


@row.wrong
def axis_row_not_column(T_zero):
    """the axis is taken from a row of R; what the link's z looks like from the world
    stands in a column => the answer with the third row"""
    return screw_axis(T_zero[:, 2, :3], T_zero[:, :3, 3])


@row.wrong
def axis_local_z(T_zero):
    """the axis is (0, 0, 1) for every joint: that is z in the link's own frame; the
    screw needs it seen from the world => the answer with (0, 0, 1)"""
    return screw_axis([0.0, 0.0, 1.0], T_zero[:, :3, 3])


@row.wrong
def axis_x_column(T_zero):
    """the axis is the links' x; the Panda's joints turn about their z => the answer
    with x"""
    return screw_axis(T_zero[:, :3, 0], T_zero[:, :3, 3])


@row.wrong
def axis_y_column(T_zero):
    """the axis is the links' y; the Panda's joints turn about their z => the answer
    with y"""
    return screw_axis(T_zero[:, :3, 1], T_zero[:, :3, 3])


@row.wrong
def point_is_local_pos(T_zero):
    """the point is each link's place on the one before, in that one's axes, as the file
    has it; the screw needs it seen from the world => the answer with those points"""
    return through(local(T_zero)[:, :3, 3], T_zero)


@row.wrong
def all_local(T_zero):
    """axis and point are each link's on the one before; the screw needs both seen from
    the world => the answer from those poses"""
    return joint_screws(local(T_zero))


@row.wrong
def poses_multiplied(T_zero):
    """the poses are multiplied along the arm; they are in the world already => the
    answer from those products"""
    return joint_screws(list(accumulate(T_zero, np.matmul)))


@row.wrong
def point_turned_back(T_zero):
    """the point is turned back into the link's axes; it is in the world already => the
    answer with R^T p"""
    return through([T[:3, :3].T @ T[:3, 3] for T in T_zero], T_zero)


@row.wrong
def next_links_point(T_zero):
    """each joint's point is the next link's origin, which need not be on its axis =>
    the answer with those points"""
    return through(np.roll(T_zero[:, :3, 3], -1, axis=0), T_zero)


for before in (
    lambda p: [p[0], *p[:-1]],
    lambda p: [p[i - 1] for i in range(7)],
    lambda p: [np.zeros(3), *p[:-1]],
):
    row.wrong(
        "previous-links-point",
        "each joint's point is the origin of the link before, which need not be on its "
        "axis",
        "the answer with those points",
    )(lambda T_zero, before=before: through(before(T_zero[:, :3, 3]), T_zero))


@row.wrong
def first_link_for_all(T_zero):
    """every screw is the first joint's: the index never moves on => the first screw,
    seven times"""
    return np.array([joint_screws(T_zero)[0] for _ in T_zero])


@row.wrong
def last_joint_first(T_zero):
    """the screws are right, but in the reverse order: joint1's comes first => the right
    answer in reverse"""
    return joint_screws(T_zero)[::-1]


row.reached_by("screw_axis", "in every screw, ")


@row.wrong("v-off")  # The points are measured from link1.
def _(T_zero):
    return through(T_zero[:, :3, 3] - T_zero[0, :3, 3], T_zero)

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


@row.wrong(
    "axis-row-not-column",
    "the axis is taken from a row of R; what the link's z looks like from the world "
    "stands in a column",
    "the answer with the third row",
)
def _(T_zero):
    return screw_axis(T_zero[:, 2, :3], T_zero[:, :3, 3])


@row.wrong(
    "axis-local-z",
    "the axis is (0, 0, 1) for every joint: that is z in the link's own frame; the "
    "screw needs it seen from the world",
    "the answer with (0, 0, 1)",
)
def _(T_zero):
    return screw_axis([0.0, 0.0, 1.0], T_zero[:, :3, 3])


@row.wrong(
    "axis-x-column",
    "the axis is the links' x; the Panda's joints turn about their z",
    "the answer with x",
)
def _(T_zero):
    return screw_axis(T_zero[:, :3, 0], T_zero[:, :3, 3])


@row.wrong(
    "axis-y-column",
    "the axis is the links' y; the Panda's joints turn about their z",
    "the answer with y",
)
def _(T_zero):
    return screw_axis(T_zero[:, :3, 1], T_zero[:, :3, 3])


@row.wrong(
    "point-is-local-pos",
    "the point is each link's place on the one before, in that one's axes, as the "
    "file has it; the screw needs it seen from the world",
    "the answer with those points",
)
def _(T_zero):
    return through(local(T_zero)[:, :3, 3], T_zero)


@row.wrong(
    "all-local",
    "axis and point are each link's on the one before; the screw needs both seen from "
    "the world",
    "the answer from those poses",
)
def _(T_zero):
    return joint_screws(local(T_zero))


@row.wrong(
    "poses-multiplied",
    "the poses are multiplied along the arm; they are in the world already",
    "the answer from those products",
)
def _(T_zero):
    return joint_screws(list(accumulate(T_zero, np.matmul)))


@row.wrong(
    "point-turned-back",
    "the point is turned back into the link's axes; it is in the world already",
    "the answer with R^T p",
)
def _(T_zero):
    return through([T[:3, :3].T @ T[:3, 3] for T in T_zero], T_zero)


@row.wrong(
    "next-links-point",
    "each joint's point is the next link's origin, which need not be on its axis",
    "the answer with those points",
)
def _(T_zero):
    return through(np.roll(T_zero[:, :3, 3], -1, axis=0), T_zero)


BEFORE = (
    "each joint's point is the origin of the link before, which need not be on its axis"
)


@row.wrong("previous-links-point", BEFORE, "the answer with those points")
def _(T_zero):
    p = T_zero[:, :3, 3]
    return through([p[0], *p[:-1]], T_zero)


@row.wrong("previous-links-point", BEFORE, "the answer with those points")
def _(T_zero):
    p = T_zero[:, :3, 3]
    return through([p[i - 1] for i in range(7)], T_zero)


@row.wrong("previous-links-point", BEFORE, "the answer with those points")
def _(T_zero):
    p = T_zero[:, :3, 3]
    return through([np.zeros(3), *p[:-1]], T_zero)


@row.wrong(
    "first-link-for-all",
    "every screw is the first joint's: the index never moves on",
    "the first screw, seven times",
)
def _(T_zero):
    return np.array([joint_screws(T_zero)[0] for _ in T_zero])


@row.wrong(
    "last-joint-first",
    "the screws are right, but in the reverse order: joint1's comes first",
    "the right answer in reverse",
)
def _(T_zero):
    return joint_screws(T_zero)[::-1]


row.reached_by("screw_axis", "in every screw, ")


@row.right  # All joints at once.
def _(T_zero):
    z, p = T_zero[:, :3, 2], T_zero[:, :3, 3]
    return np.hstack([z, np.cross(p, z)])

"""2.5 `joint_screws(T_zero)`: its questions and its mistakes."""

from functools import partial
from itertools import accumulate

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import FIRST_FOR_ALL
from robo47 import se3
from robo47.screws import screw_axis

from .arms import SCREWS, the_panda
from .halves import which_half

row = Row(SCREWS, unnamed=which_half)


@row.inputs
def _(rng):
    yield (the_panda()[2],)
    for _ in range(7):
        yield (rng.poses(7),)


@row.wrongs
def _(T_zero):
    """axis-row-not-column: the axis is taken from a row of R; what the link's z looks
      like from the world stands in a column => the answer with the third row
    axis-local-z: the axis is (0, 0, 1) for every joint: that is z in the link's own
      frame; the screw needs it seen from the world => the answer with (0, 0, 1)
    axis-x-column: the axis is the links' x; the Panda's joints turn about their z
    axis-y-column: the axis is the links' y; the Panda's joints turn about their z
    point-is-local-pos: the point is each link's place on the one before, in that one's
      axes, as the file has it; the screw needs it seen from the world
    all-local: axis and point are each link's on the one before; the screw needs both
      seen from the world => the answer from those poses
    poses-multiplied: the poses are multiplied along the arm; they are in the world
      already => the answer from those products
    point-turned-back: the point is turned back into the link's axes; it is in the world
      already => the answer with R^T p
    next-links-point: each joint's point is the next link's origin, which need not be on
      its axis => the answer with those points
    last-joint-first: the screws are right, but in the reverse order: joint1's comes
      first => the right answer in reverse
    """
    R = T_zero[:, :3, :3]
    p = T_zero[:, :3, 3]
    x, y, z = np.moveaxis(R, -1, 0)
    local = se3.inverse(np.array([np.eye(4), *T_zero[:-1]])) @ T_zero
    carried = np.array(list(accumulate(T_zero, np.matmul)))
    lines = {
        "axis-row-not-column": (R[:, 2], p),
        "axis-local-z": ([0.0, 0.0, 1.0], p),
        "axis-x-column": (x, p),
        "axis-y-column": (y, p),
        "point-is-local-pos": (z, local[:, :3, 3]),
        "all-local": (local[:, :3, 2], local[:, :3, 3]),
        "poses-multiplied": (carried[:, :3, 2], carried[:, :3, 3]),
        "point-turned-back": (z, np.einsum("nij,ni->nj", R, p)),
        "next-links-point": (z, np.roll(p, -1, axis=0)),
        "last-joint-first": (z[::-1], p[::-1]),
    }
    return {slug: partial(screw_axis, *line) for slug, line in lines.items()}


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
    )(
        lambda T_zero, before=before: screw_axis(
            T_zero[:, :3, 2], before(T_zero[:, :3, 3])
        )
    )


row.of_argument("T_zero", FIRST_FOR_ALL.called("first-link-for-all"))
row.reached_by("screw_axis", "in every screw, ")


@row.wrong("v-off")  # The points are measured from link1.
def _(T_zero):
    return screw_axis(T_zero[:, :3, 2], T_zero[:, :3, 3] - T_zero[0, :3, 3])

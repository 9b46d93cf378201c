"""2.5 `joint_screws(T_zero)`: its questions and its mistakes."""

from functools import partial
from itertools import accumulate

import numpy as np

from labkit.judge import Row
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
    """axis-row-not-column: the axis is a row of R; the link's z axis, expressed in the
      world frame, is a column => the answer with the third row
    axis-local-z: the axis is (0, 0, 1) for every joint, which is z in the link frame.
      The screw should be expressed in the world frame => the answer with (0, 0, 1)
    axis-x-column: the axis is the link's x axis; the Panda's joints rotate about z
    axis-y-column: the axis is the link's y axis; the Panda's joints rotate about z
    point-is-local-pos: the point is the position of each link relative to its parent;
      the screw is expressed in the world frame
    all-local: the axis and the point are relative to the parent link; the screw is
      expressed in the world frame => the answer from those poses
    poses-multiplied: the poses are multiplied along the arm; the given poses are
      already relative to the world => the answer from those products
    point-turned-back: the point is rotated into the link frame; the point is already
      expressed in the world frame => the answer with R^T p
    next-links-point: the point of each joint is the origin of the next link, which is
      not always on the joint's axis => the answer with those points
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
    }
    return {slug: partial(screw_axis, *line) for slug, line in lines.items()}


for before in (
    lambda p: [p[0], *p[:-1]],
    lambda p: [p[i - 1] for i in range(7)],
    lambda p: [np.zeros(3), *p[:-1]],
):
    row.wrong(
        "previous-links-point",
        "the point of each joint is the origin of the previous link, which is not "
        "always on the joint's axis",
        "the answer with those points",
    )(
        lambda T_zero, before=before: screw_axis(
            T_zero[:, :3, 2], before(T_zero[:, :3, 3])
        )
    )


row.reached_by("screw_axis", "in every screw, ")


@row.wrong("v-off")  # The points are measured from link1.
def _(T_zero):
    return screw_axis(T_zero[:, :3, 2], T_zero[:, :3, 3] - T_zero[0, :3, 3])

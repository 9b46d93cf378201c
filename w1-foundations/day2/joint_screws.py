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
    """axis-row-not-column: your axis is R^T z, which is the third row of the rotation
      matrix R. Use the third column instead, which is the link's z axis expressed in
      the world frame
    axis-local-z: your code uses the axis (0, 0, 1) for every joint, which is the z axis
      expressed in the link frame. Express this axis in the world frame instead
    axis-x-column: your code uses the link's x axis. Use the link's z axis instead,
      because the Panda's joints rotate about z
    axis-y-column: your code uses the link's y axis. Use the link's z axis instead,
      because the Panda's joints rotate about z
    point-is-local-pos: your code uses the link's position relative to its parent as the
      point on the axis. Use the position relative to the world instead, because the
      screw should be expressed in the world frame
    all-local: your code uses an axis and a point that are expressed in the frame of the
      parent link. Express both in the world frame instead, because the screw should be
      expressed in the world frame
    poses-multiplied: your code multiplies each pose by the poses of all previous links.
      Use each pose unchanged, because the given poses are already relative to the world
    point-turned-back: your code rotates the point into the link frame. Use the point
      unchanged, because it is already expressed in the world frame
    next-links-point: your code uses the origin of the next link, and of link1 for
      joint7, as the point on the axis. This origin is not always on the axis. Use the
      origin of the link that the joint moves
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
        "your code uses the origin of the previous link as the point on the axis, but "
        "this origin is not always on the axis. Use the origin of the link that the "
        "joint moves",
    )(
        lambda T_zero, before=before: screw_axis(
            T_zero[:, :3, 2], before(T_zero[:, :3, 3])
        )
    )


for first in (np.eye(4), None):

    @row.wrong("previous-links-axis")
    def _(T_zero, first=first):
        """your code uses the axis and the origin of the previous link. Joint i rotates
        about the z axis of link i, so use the pose of this link"""
        start = T_zero[0] if first is None else first
        poses = np.array([start, *T_zero[:-1]])
        return screw_axis(poses[:, :3, 2], poses[:, :3, 3])


row.reached_by("screw_axis", "in every screw, ")


@row.wrong("v-off")  # The points are measured from link1.
def _(T_zero):
    return screw_axis(T_zero[:, :3, 2], T_zero[:, :3, 3] - T_zero[0, :3, 3])

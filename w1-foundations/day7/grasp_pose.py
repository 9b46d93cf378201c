"""7.7 `grasp_pose(T_world_cube, above)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row, rounded
from robo47 import se3
from robo47.lifting import grasp_pose

DOWN = np.diag([1.0, -1.0, -1.0])
QUARTER = np.pi / 2

row = Row(Pose())


@row.inputs
def _(rng):
    """Give cubes at many yaws, none half way between two quarter turns.

    The first ones are typed: among them hardly any yaw, and no height at all.
    """
    quarters = np.arange(-2, 3)[rng.permutation(5)]
    yaw = quarters * np.pi / 2 + rng.uniform(-0.7, 0.7, 5)
    yaw = [np.radians(80.0), 0.3, -0.5, np.radians(-130.0), *rounded(yaw)]
    place = rng.numbers(0.1, 0.7, len(yaw), 3)
    place[1, 2] *= -1.0  # a cube lower than the arm stands
    above = map(float, rng.numbers(0.02, 0.3, len(yaw)))
    rows = list(zip(se3.make_T(se3.Rz(np.array(yaw)), place), above, strict=True))
    p = np.array([0.55, -0.15, 0.22])
    low = [(np.radians(0.5), 0.0), (np.radians(-91.0), 0.005)]
    return [*rows[:4], *((se3.make_T(se3.Rz(a), p), h) for a, h in low), *rows[4:]]


def tool(T_world_cube, above, yaw):
    """Return the tool's pose over the cube, turned by a yaw of one's own."""
    return se3.make_T(se3.Rz(yaw) @ DOWN, T_world_cube[:3, 3] + [0.0, 0.0, above])


@row.wrongs
def _(T_world_cube, above):
    """yaw-not-folded: the tool turns with the cube all the way; a cube looks the same
      after a quarter turn, and joint 7 has an end
    folded-to-90: the yaw is folded into 0..90 degrees; into +-45 the tool turns less =>
      the pose with yaw mod 90 degrees
    rounded-towards-zero: the number of quarter turns is cut off, not rounded: up to 90
      degrees stay => the pose with whole quarter turns cut off
    folded-by-half-turns: half turns are taken off; a cube looks the same after a
      quarter already => the pose with half turns taken off
    yaw-forgotten: the tool does not turn with the cube: the fingers meet its edges =>
      the pose at yaw 0
    turned-the-wrong-way: the tool turns the other way than the cube: look at the yaw
      (its sign, and which entries atan2 takes), then at the order of the turn and
      diag(1, -1, -1) => the pose with -yaw
    """
    yaw = np.arctan2(T_world_cube[1, 0], T_world_cube[0, 0])
    yaws = {
        "yaw-not-folded": yaw,
        "folded-to-90": np.mod(yaw, QUARTER),
        "rounded-towards-zero": yaw - np.trunc(yaw / QUARTER) * QUARTER,
        "folded-by-half-turns": yaw - np.round(yaw / np.pi) * np.pi,
        "yaw-forgotten": 0.0,
        "turned-the-wrong-way": np.round(yaw / QUARTER) * QUARTER - yaw,
    }
    return {slug: partial(tool, T_world_cube, above, one) for slug, one in yaws.items()}


@row.wrongs
def _(T_world_cube, above):
    """tool-up: the tool looks up: its z axis has to point down => the pose with z up
    about-y: the tool is turned over about y: at yaw 0 its x points backwards
    left-handed: turning only z over makes a mirror image: the determinant is -1 => the
      pose with diag(1, 1, -1)
    height-subtracted: the tool is below the cube: above counts up, and the tool's own z
      points down => the pose below the cube
    height-forgotten: the tool is in the cube's centre: above is not added
    place-forgotten: the tool is over the world's origin: the cube's place is missing
    """
    right = grasp_pose(T_world_cube, above)
    own = right @ np.diag([1.0, -1.0, -1.0, 1.0])
    return {
        "tool-up": own,
        "about-y": own @ np.diag([-1.0, 1.0, -1.0, 1.0]),
        "left-handed": own @ np.diag([1.0, 1.0, -1.0, 1.0]),
        "height-subtracted": grasp_pose(T_world_cube, -above),
        "height-forgotten": grasp_pose(T_world_cube, 0.0),
        "place-forgotten": se3.make_T(right[:3, :3], [0.0, 0.0, above]),
    }


@row.right  # T_world_cube @ T_cube_tcp, the best of four.
def _(T_world_cube, above):
    best = None
    for k in range(4):
        c, s = round(np.cos(k * np.pi / 2)), round(np.sin(k * np.pi / 2))
        T_cube_tcp = [[c, s, 0, 0], [s, -c, 0, 0], [0, 0, -1, above], [0, 0, 0, 1]]
        T = T_world_cube @ np.array(T_cube_tcp)
        best = T if best is None or T[0, 0] > best[0, 0] else best
    return best


@row.right  # Quarter turns taken off one by one.
def _(T_world_cube, above):
    x = T_world_cube[:3, 0]
    z = np.array([0.0, 0.0, -1.0])
    for _ in range(3):
        if x[0] < abs(x[1]):
            x = np.array([x[1], -x[0], 0.0])
    R = np.stack([x, np.cross(z, x), z], axis=1)
    return se3.make_T(R, T_world_cube[:3, 3] + [0.0, 0.0, above])


row.at_least_0(above="a height over the cube")

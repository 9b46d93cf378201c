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
    """Return cubes at many yaws, none half way between two quarter turns.

    The first ones are typed and include a yaw of nearly 0 and a height of 0.
    """
    quarters = np.arange(-2, 3)[rng.permutation(5)]
    yaw = quarters * np.pi / 2 + rng.uniform(-0.7, 0.7, 5)
    yaw = [np.radians(80.0), 0.3, -0.5, np.radians(-130.0), *rounded(yaw)]
    place = rng.numbers(0.1, 0.7, len(yaw), 3)
    place[1, 2] *= -1.0  # a cube below the base of the arm
    above = map(float, rng.numbers(0.02, 0.3, len(yaw)))
    rows = list(zip(se3.make_T(se3.Rz(np.array(yaw)), place), above, strict=True))
    p = np.array([0.55, -0.15, 0.22])
    low = [(np.radians(0.5), 0.0), (np.radians(-91.0), 0.005)]
    return [*rows[:4], *((se3.make_T(se3.Rz(a), p), h) for a, h in low), *rows[4:]]


def tool(T_world_cube, above, yaw):
    """Return the pose of the tool over the cube with another yaw."""
    return se3.make_T(se3.Rz(yaw) @ DOWN, T_world_cube[:3, 3] + [0.0, 0.0, above])


@row.wrongs
def _(T_world_cube, above):
    """yaw-not-folded: your code gives the tool the full yaw of the cube. Use the
      equivalent yaw between -45 and 45 degrees, because a rotation by 90 degrees does
      not change a cube
    folded-to-90: your code reduces the yaw to an angle between 0 and 90 degrees. Reduce
      the yaw to an angle between -45 and 45 degrees instead
    rounded-towards-zero: in your result, the number of quarter turns is rounded towards
      0, as by `int` or `fmod`, so a yaw of up to 90 degrees remains. Round this number
      to the nearest integer instead
    folded-by-half-turns: your tool has a yaw between -90 and 90 degrees. Use a yaw
      between -45 and 45 degrees instead, because a rotation by 90 degrees does not
      change a cube
    yaw-forgotten: your code gives the tool a yaw of 0 for every cube. Use the yaw of
      the cube, reduced to an angle between -45 and 45 degrees
    turned-the-wrong-way: your code rotates the tool in the opposite direction to the
      cube. Check the arguments of arctan2, the sign of the yaw and the order of the
      product with diag(1, -1, -1)
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
    """tool-up: your code returns a pose in which the z axis of the tool points up.
      Rotate the tool by 180 degrees about its x axis, so that its z axis points down
    about-y: your tool is rotated by 180 degrees about the vertical, as by a yaw that is
      off by 180 degrees or by a rotation about the y axis that points the tool down. At
      a yaw of 0, the x axis of the tool should have the direction of the world x axis
    left-handed: your code reverses only the z axis, so the matrix is a reflection with
      determinant -1. Reverse the y axis as well, because a rotation matrix has
      determinant 1
    """
    right = grasp_pose(T_world_cube, above)
    own = right @ np.diag([1.0, -1.0, -1.0, 1.0])
    return {
        "tool-up": own,
        "about-y": own @ np.diag([-1.0, 1.0, -1.0, 1.0]),
        "left-handed": own @ np.diag([1.0, 1.0, -1.0, 1.0]),
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


row.at_least_0(above="a height over the cube is not negative")

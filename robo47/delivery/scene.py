"""The scene of the delivery: Day 7's table, a wall across it, an eye above it.

The arm does not know where the cube is or what it weighs. Metres, radians, kilograms;
halves of boxes.
"""

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import depth_camera, scenes, se3
from robo47.checks import Array

WALL_AT = (0.56, 0.0, 0.35)  # m, its middle; READY clears it by 77 mm
WALL_HALF = (0.14, 0.01, 0.15)  # m
EYE_AT = np.array([1.15, 0.0, 0.9])  # m, Day 10's eye, and ...
EYE_TO = np.array([0.5, 0.0, 0.2])  # ... m, what it looks at
EYE_HALF = (0.03, 0.02, 0.05)  # m, long along its view
FOVY = 45.0  # degrees
PIXELS = (320, 240)  # width, height


def table_with_wall(
    cube_xy: ArrayLike,
    yaw: float,
    mass: float,
    *,
    friction: float = scenes.FRICTION,
    wall: bool = True,
    meshes: bool = False,
) -> mujoco.MjModel:
    """Return the Panda at a table, a cube on one side of a wall.

    Args:
        cube_xy, yaw, mass, friction, meshes: as in `robo47.scenes.table_top`.
        wall: False leaves the wall out.

    Returns:
        The model; it has a camera "eye" and a geom "wall", which the cube and the
        fingers' pads touch.
    """

    def add(spec: mujoco.MjSpec) -> None:
        seen = depth_camera.add(spec.worldbody, "eye", EYE_AT, EYE_TO, FOVY, PIXELS)
        if meshes:  # looks alone: its rays begin inside
            box = spec.worldbody.add_geom(
                name="eye", type=mujoco.mjtGeom.mjGEOM_BOX, pos=EYE_AT, size=EYE_HALF
            )
            box.quat = seen.quat
            box.contype = box.conaffinity = 0
            box.rgba = [0.15, 0.15, 0.18, 1.0]
        if not wall:
            return
        geom = spec.worldbody.add_geom(
            name="wall", type=mujoco.mjtGeom.mjGEOM_BOX, pos=WALL_AT, size=WALL_HALF
        )
        # Without this the arm would pass through the wall.
        geom.contype = geom.conaffinity = 1
        geom.rgba = [0.45, 0.55, 0.70, 1.0]

    return scenes.table_top(
        cube_xy, yaw, mass=mass, friction=friction, meshes=meshes, add=add
    )


def boxes(wall: bool = True) -> list[tuple[Array, Array]]:
    """Return what the arm must not touch: the table, and the wall if there is one.

    Returns:
        `T_world_box`, (4, 4), and half its sides, (3,), of each.
    """
    half = np.array([*scenes.TABLE_HALF, scenes.TABLE_HEIGHT / 2.0])
    table = se3.make_T(np.eye(3), [*scenes.TABLE_CENTRE, scenes.TABLE_HEIGHT / 2.0])
    found = [(table, half)]
    if wall:
        found.append((se3.make_T(np.eye(3), WALL_AT), np.array(WALL_HALF)))
    return found

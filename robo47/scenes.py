"""Scenes with contacts: a table with a cube to pick up, and a table to press on.

Each function returns a compiled model with torque drives; the constants define the
positions. Objects are found by name: bodies `table`, `cube` and `hand`, sites `tcp` and
`attachment_site`, geoms `table_top`, `cube`, `tip`. Only the parts that are added here
(finger pads, tip) can touch anything, so every contact belongs to the lesson. Metres,
radians, kilograms; lengths of boxes are halves.
"""

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, panda, se3
from robo47.checks import Array

TABLE_HEIGHT = 0.2  # m, of the table's top in `table_top`
TABLE_CENTRE = (0.5, 0.0)  # m, of both tables, x in front of the robot's base
TABLE_HALF = (0.2, 0.45)  # m
CUBE_HALF = 0.02  # m: the cube is 40 mm wide, the open hand 80 mm
CUBE_MASS = 0.08  # kg; the hand's grip lifts up to 0.17
FRICTION = 1.0  # sliding, of pads and cube; below about 0.45 the cube slips out
# Time constant of the grip's contacts, s; two time steps, the least MuJoCo allows. Its
# contacts leave out the change of the Jacobian (Jdot qd), so a carried cube creeps
# outwards while the arm swings: 7.2 mm at MuJoCo's default of 0.02, 0.9 mm at 0.004.
GRIP_TIME = 0.004
TCP = (0.0, 0.0, 0.1034)  # m, on `hand`: between the middles of the two pads
PAD_HALF = (0.0085, 0.004, 0.0085)  # m, the Menagerie's own fingertip pads
PAD_POS = (0.0, 0.0055, 0.0445)  # m, on each finger

PRESS_HEIGHT = 0.4  # m, of the table's top in `press_table`
TIP_RADIUS = 0.02  # m, of the ball whose centre is `attachment_site`
PRESS_XY = (0.44, 0.0)  # m, a good place to press; how stiff the arm is depends on it
TOUCH = PRESS_HEIGHT + TIP_RADIUS  # m, height of `attachment_site` at first touch


def table_top(
    cube_xy: ArrayLike = (0.5, 0.2),
    yaw: float = 0.0,
    *,
    mass: float = CUBE_MASS,
    friction: float = FRICTION,
    meshes: bool = False,
    add: Callable[[mujoco.MjSpec], None] | None = None,
) -> mujoco.MjModel:
    """Return the Panda with its hand at a table with a cube on it.

    Args:
        cube_xy: position of the cube on the table, metres, (2,).
        yaw: its rotation about z in radians.
        mass: of the cube in kg, above 0.
        friction: coefficient of sliding friction of cube and finger pads, at least 0.
        meshes: True keeps the robot's visual meshes; it moves in the same way.
        add: a function that adds more to the scene before it is compiled.

    Returns:
        The model: motors on the arm's seven joints, the hand's own servo (ctrl 0
        closed to 255 open), site `tcp`, a `home` key that includes the cube.

    Raises:
        ValueError: a wrong shape or number, or the cube is not on the table.
        Robo47Error: the robot's files are broken.
    """
    xy = on_table(cube_xy, "cube_xy")
    checks.positive(mass, "mass")
    checks.not_negative(friction, "friction")
    pose = [*xy, TABLE_HEIGHT + CUBE_HALF, *se3.R_to_quat(se3.Rz(yaw))]

    def edit(spec: mujoco.MjSpec) -> None:
        _untouchable(spec)
        spec.option.impratio = 10.0  # panda.xml has 1: the cube would creep in the grip
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.body("hand").add_site(name="tcp", pos=TCP)
        for finger in ("left_finger", "right_finger"):
            pad = _box(spec.body(finger), f"{finger}_pad", PAD_HALF, PAD_POS, friction)
            pad.solref[0] = GRIP_TIME
        _add_table(spec, TABLE_HEIGHT)
        cube = spec.worldbody.add_body(name="cube", pos=pose[:3], quat=pose[3:])
        cube.add_freejoint()
        geom = _box(cube, "cube", (CUBE_HALF,) * 3, (0.0, 0.0, 0.0), friction)
        geom.mass = mass
        geom.solref[0] = GRIP_TIME
        geom.rgba = [0.95, 0.55, 0.15, 1.0]
        for key in spec.keys:  # the cube adds seven numbers to qpos
            key.qpos = [*key.qpos, *pose]
        if add is not None:
            add(spec)

    return panda.load("panda", drive="torque", meshes=meshes, edit=edit)


def press_table(*, drive: str = "torque", meshes: bool = False) -> mujoco.MjModel:
    """Return the arm without a hand, with a sphere as its tip, over a table.

    Args:
        drive: "torque", or "servo" for the Menagerie's stiff position drives.
        meshes: True keeps the robot's visual meshes.

    Returns:
        The model; the centre of the sphere is `attachment_site`.

    Raises:
        ValueError: no such drive.
        Robo47Error: the robot's files are broken.
    """

    def edit(spec: mujoco.MjSpec) -> None:
        _untouchable(spec)
        tip = spec.body("attachment").add_geom(
            name="tip", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[TIP_RADIUS, 0, 0]
        )
        tip.contype = tip.conaffinity = 1
        tip.mass = 0.0  # the mass of the arm stays as it is
        _add_table(spec, PRESS_HEIGHT)

    return panda.load("panda_nohand", drive=drive, meshes=meshes, edit=edit)


def hang_kilogram(spec: mujoco.MjSpec) -> None:
    """Fix a body of 1 kg to the end of the arm without a hand; an `edit` of it."""
    ball = {"mass": 1.0, "inertia": [1e-4, 1e-4, 1e-4], "explicitinertial": True}
    spec.body("attachment").add_body(name="load", **ball)


def on_table(xy: ArrayLike, name: str) -> Array:
    """Return a position for the cube, (2,), after checking that it is on the table.

    Args:
        xy: metres, (2,).
        name: of the argument, for the error.

    Raises:
        ValueError: a wrong shape, or it is not on the table.
    """
    xy = checks.array(xy, name, (2,))
    half = np.array(TABLE_HALF)
    if np.any(np.abs(xy - TABLE_CENTRE) > half - CUBE_HALF):
        low, high = (np.round(np.add(TABLE_CENTRE, k * half), 3) for k in (-1, 1))
        raise ValueError(
            f"{name} {xy.tolist()} is not on the table, which reaches from"
            f" {low.tolist()} to {high.tolist()}"
        )
    return xy


def contact_force(
    model: mujoco.MjModel, data: mujoco.MjData, geom: str, other: str
) -> float:
    """Return the normal force between two geoms, summed over their contacts.

    Args:
        model: any model.
        data: after mj_step or mj_forward; the forces belong to the last step.
        geom, other: names of the two.

    Returns:
        Newtons; 0 if they do not touch.
    """
    pair = {model.geom(geom).id, model.geom(other).id}
    total = 0.0
    wrench = np.zeros(6)
    for i in range(data.ncon):
        if {int(data.contact[i].geom1), int(data.contact[i].geom2)} == pair:
            mujoco.mj_contactForce(model, data, i, wrench)
            total += float(wrench[0])
    return total


def _add_table(spec: mujoco.MjSpec, height: float) -> None:
    body = spec.worldbody.add_body(name="table", pos=[*TABLE_CENTRE, height / 2.0])
    top = _box(body, "table_top", (*TABLE_HALF, height / 2.0), (0.0, 0.0, 0.0), 1.0, 3)
    top.mass = 0.0  # it cannot move; the model's mass stays the robot's
    top.rgba = [0.80, 0.74, 0.66, 1.0]


def _box(body, name: str, half, pos, friction: float, condim: int = 4):
    """Add a box; condim 4 also resists turning about the contact's normal."""
    geom = body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=half, pos=pos)
    geom.friction[0] = friction
    geom.condim = condim
    geom.contype = geom.conaffinity = 1  # the twin's own default is 0
    return geom


def _untouchable(spec: mujoco.MjSpec) -> None:
    """Let nothing that the robot brings along touch anything."""
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0

"""The scene of the push: the Panda with a sphere on a stick, a puck, an eye below.

The puck slides on a glass tray, so the eye below it sees it whatever the arm does. The
plane of Week 3's policy (`robo47.push`) is the plane of the centres of sphere and puck;
its origin, home, is at HOME in the world. The geom "mark" is a green disc that shows
home; nothing touches it. Metres, kilograms.
"""

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, panda, push, scenes, simulate
from robo47.checks import Array
from robo47.panda import READY_Q

HOME = (0.5, 0.0)  # m, of home in the world
TRAY = 0.2  # m, height of the mark's top
PUCK_HALF = 0.015  # m, half the height of the puck
HEIGHT = TRAY + PUCK_HALF + 0.001  # m, of the plane; the puck floats over the glass
STICK = 0.08  # m, from between the fingers to the centre of the sphere
STICK_RADIUS = 0.004  # m
TRAY_HALF = (0.3, 0.3, 0.005)  # m
EYE = (*HOME, 0.03)  # m
EYE_HALF = (0.05, 0.05, 0.02)  # m
MARK_HALF = (push.PUCK, 0.001, 0.0)  # m, radius and half the height
CONTACT = 0.004  # s, time constant of the contact: two time steps
GLASS = (0.55, 0.75, 0.85, 0.25)
ORANGE = (0.90, 0.62, 0.0, 1.0)
GREEN = (0.30, 0.76, 0.43, 1.0)
DARK = (0.15, 0.15, 0.18, 1.0)


def tray(
    puck: ArrayLike,
    *,
    mass: float = push.MASS,
    damping: float = push.DAMPING,
    meshes: bool = False,
) -> mujoco.MjModel:
    """Return the Panda over the tray; its joints "puck x" and "puck y" move the puck.

    Args:
        puck: position of the puck in the plane, relative to home, metres, (2,).
        mass: of the puck, kg.
        damping: of the puck's joints, N s/m.
        meshes: True keeps the robot's visual meshes.

    Returns:
        The model; site `tcp` is the centre of the sphere.

    Raises:
        ValueError: a wrong shape or number.
        Robo47Error: the robot's files are broken.
    """
    puck = checks.array(puck, "puck", (2,))
    checks.positive(mass, "mass")
    checks.not_negative(damping, "damping")

    def edit(spec: mujoco.MjSpec) -> None:
        for geom in spec.geoms:
            geom.contype = geom.conaffinity = 0
        _add_sphere(spec.body("hand"))
        _add_puck(spec, mass, damping)
        _add_looks(spec)
        for key in spec.keys:  # the puck adds two numbers to qpos
            key.qpos = [*key.qpos, *puck]

    return panda.load("panda", drive="torque", meshes=meshes, edit=edit)


def start(model: mujoco.MjModel) -> mujoco.MjData:
    """Return the state of the scene, the arm ready, the stick between its fingers."""
    data = simulate.start(model, READY_Q)
    data.qpos[[model.joint(f"finger_joint{i}").qposadr[0] for i in (1, 2)]] = 0.0
    data.ctrl[7:] = 0.0  # closed
    mujoco.mj_forward(model, data)
    return data


def puck_address(model: mujoco.MjModel) -> int:
    """Return the index of the puck's x in qpos; its y follows."""
    return int(model.joint("puck x").qposadr[0])


def world(xy: ArrayLike) -> Array:
    """Return the world's coordinates of a point of the plane, (3,)."""
    return np.array([*np.add(HOME, xy), HEIGHT])


def _add_sphere(hand) -> None:
    """Fix the stick and the sphere to the hand; both are without mass."""
    at = np.add(scenes.TCP, (0.0, 0.0, STICK))
    hand.add_site(name="tcp", pos=at)
    stick = hand.add_geom(
        name="stick", type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[STICK_RADIUS, 0, 0]
    )
    stick.fromto = [*scenes.TCP, *at]
    sphere = hand.add_geom(
        name="sphere",
        type=mujoco.mjtGeom.mjGEOM_SPHERE,
        size=[push.PUSHER, 0, 0],
        pos=at,
    )
    _touches(sphere)
    stick.contype = stick.conaffinity = 0
    for geom in (stick, sphere):
        geom.mass = 0.0
        geom.rgba = DARK


def _add_puck(spec: mujoco.MjSpec, mass: float, damping: float) -> None:
    puck = spec.worldbody.add_body(name="puck", pos=world((0.0, 0.0)))
    for name, axis in (("x", (1.0, 0.0, 0.0)), ("y", (0.0, 1.0, 0.0))):
        slide = mujoco.mjtJoint.mjJNT_SLIDE
        joint = puck.add_joint(name=f"puck {name}", type=slide, axis=axis)
        joint.damping = damping if np.ndim(joint.damping) == 0 else [damping, 0, 0]
    geom = puck.add_geom(
        name="puck",
        type=mujoco.mjtGeom.mjGEOM_CYLINDER,
        size=[push.PUCK, PUCK_HALF, 0],
    )
    _touches(geom)
    geom.mass = mass
    geom.rgba = ORANGE


def _add_looks(spec: mujoco.MjSpec) -> None:
    """Add tray, eye and mark, which nothing touches."""
    box, disc = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CYLINDER
    floor = TRAY - 2.0 * MARK_HALF[1]  # below the mark, so that both are seen
    middle = (*HOME, floor - TRAY_HALF[2])
    for name, kind, pos, half, colour in (
        ("tray", box, middle, TRAY_HALF, GLASS),
        ("eye", box, EYE, EYE_HALF, DARK),
        ("mark", disc, (*HOME, TRAY - MARK_HALF[1]), MARK_HALF, GREEN),
    ):
        geom = spec.worldbody.add_geom(name=name, type=kind, pos=pos, size=half)
        geom.contype = geom.conaffinity = 0
        geom.rgba = colour


def _touches(geom) -> None:
    """Let a geom touch another one, without friction."""
    geom.contype = geom.conaffinity = 1
    geom.condim = 1
    geom.solref[0] = CONTACT

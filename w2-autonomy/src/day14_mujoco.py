"""Day 14 in MuJoCo: a hand with two pads, a cube, and the contact forces of the pads.

The hand floats: it is placed above a position and rotated, a servo moves it down and
up, and springs of 200 N/m close its two pads. Without an arm an episode takes
milliseconds. Metres, radians, newtons, kilograms; world frame, z up, the floor at 0.
"""

import contextlib
from collections.abc import Callable, Iterator
from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import se3
from robo47.checks import Array

HALF = 0.02  # m: the cube is 40 mm wide
PAD_HALF = (0.0085, 0.004, 0.0085)  # m, the Panda's own finger pads
OPEN = 0.04  # m, distance of each open pad from the middle
SPRING = 200.0  # N/m of each finger; the grip force is SPRING (HALF - opening)
STEP = 0.01 / 3  # s, the time step
GRIP_TIME = 2 * STEP  # s: the stiffest contacts that MuJoCo allows
ABOVE = 0.08  # m above the grasp, where the hand starts
DOWN = 0.1  # s: the hand is at the height of the grasp, the pads begin to close
CLOSED = 0.35  # s: the pads are closed, the hand begins to rise
RISE = 0.3  # s, the duration of the lift
HOLD = 0.1  # s, how long the hand holds the cube at the end
TICK = 3  # steps between two commands to hand and pads: 10 ms
WARNINGS = (
    mujoco.mjtWarning.mjWARN_BADQPOS,
    mujoco.mjtWarning.mjWARN_BADQVEL,
    mujoco.mjtWarning.mjWARN_BADQACC,
)


class Cube(NamedTuple):
    """A cube on the floor: pose, mass and friction."""

    x: float  # m
    y: float
    yaw: float  # rad
    mass: float  # kg
    mu: float  # friction of its sides


class Felt(NamedTuple):
    """The contacts between the pads and the cube."""

    points: Array  # m, (n, 3)
    force: Array  # N on the cube, (n, 3)
    normal: Array  # out of the pad into the cube, (n, 3)
    mu: Array  # (n,)


def hand() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a hand over a floor with a cube: bodies `hand` and `cube`."""
    spec = mujoco.MjSpec()
    spec.option.timestep = STEP
    spec.option.impratio = 10.0  # without it the cube creeps through the pads
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    box = mujoco.mjtGeom.mjGEOM_BOX
    floor = spec.worldbody.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(1, 1, 0.1)
    )
    floor.contype, floor.conaffinity = 1, 0
    palm = spec.worldbody.add_body(name="hand", gravcomp=1)
    slide = mujoco.mjtJoint.mjJNT_SLIDE
    palm.add_joint(name="height", type=slide, axis=(0, 0, 1))
    palm.mass, palm.inertia, palm.explicitinertial = 0.5, (1e-3,) * 3, True
    servo(spec, "height", 5000.0)
    for name, side in (("left", 1), ("right", -1)):
        finger = palm.add_body(name=name, gravcomp=1)
        finger.add_joint(name=name, type=slide, axis=(0, side, 0))
        pad = finger.add_geom(
            name=name, type=box, size=PAD_HALF, pos=(0, side * PAD_HALF[1], 0)
        )
        pad.mass = 0.05
        pad.contype, pad.conaffinity = 1, 0
        servo(spec, name, SPRING)
    cube = spec.worldbody.add_body(name="cube", pos=(0, 0, HALF))
    cube.add_freejoint(name="cube")
    geom = cube.add_geom(name="cube", type=box, size=(HALF,) * 3)
    geom.contype, geom.conaffinity = 0, 1
    geom.priority = 1  # friction and stiffness of a contact are the cube's
    geom.condim = 3
    geom.solref[0] = GRIP_TIME
    geom.mass = 0.1
    model = spec.compile()
    return model, mujoco.MjData(model)


def servo(spec, joint: str, stiffness: float) -> None:
    """Add a spring with critical damping that pulls a joint to its ctrl."""
    one = spec.add_actuator(name=joint, target=joint)
    one.trntype = mujoco.mjtTrn.mjTRN_JOINT
    one.biastype = mujoco.mjtBias.mjBIAS_AFFINE
    one.gainprm[0] = stiffness
    one.biasprm[1:3] = -stiffness, 1.0  # positive: a damping ratio, not a damping


def start(model, data, cube: Cube, action: Array) -> None:
    """Put the cube on the floor and the open hand above the position of the action."""
    mujoco.mj_resetData(model, data)  # also the warnings' counters
    body = model.body("cube").id
    model.body_mass[body] = cube.mass
    model.body_inertia[body] = cube.mass * (2 * HALF) ** 2 / 6
    model.geom("cube").friction[0] = cube.mu
    hand = model.body("hand").id
    model.body_pos[hand, :2] = action[:2]
    model.body_quat[hand] = se3.R_to_quat(se3.Rz(action[2]))
    mujoco.mj_setConst(model, data)  # recomputes the constants of the model
    data.joint("cube").qpos[:3] = cube.x, cube.y, HALF
    data.joint("cube").qpos[3:] = se3.R_to_quat(se3.Rz(cube.yaw))
    data.joint("height").qpos[0] = action[3] + ABOVE
    for finger in ("left", "right"):
        data.joint(finger).qpos[0] = OPEN


def way(action: Array, rise: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the commands every 10 ms: height, m, and closing of the pads, 0 to 1.

    Both are (n,), from the start of an episode to its end.
    """
    t = STEP * TICK * np.arange(round((CLOSED + rise + HOLD) / STEP / TICK))
    down = ABOVE * (1.0 - eased(t / DOWN))
    up = action[5] * eased((t - CLOSED) / rise)
    return action[3] + down + up, eased((t - DOWN) / (0.8 * (CLOSED - DOWN)))


def eased(s: np.ndarray) -> np.ndarray:
    """Return a smooth path from 0 to 1 that starts and ends at rest."""
    s = np.clip(s, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def at_pads(model, data) -> np.ndarray:
    """Return the indices of the contacts between pad and cube, of the last step."""
    geoms = data.contact.geom  # (n, 2); every contact involves the cube
    return np.flatnonzero((geoms != model.geom("floor").id).all(axis=1))


def on_the_floor(model, data) -> bool:
    """Return whether the floor touches the cube, at the last step."""
    return bool((data.contact.geom == model.geom("floor").id).any())


def felt(model, data) -> Felt:
    """Return the contacts between the pads and the cube, at the last step."""
    some = at_pads(model, data)
    wrench = np.zeros((len(some), 6))
    for i, row in zip(some, wrench, strict=True):
        mujoco.mj_contactForce(model, data, i, row)  # in the contact's axes
    contact = data.contact
    axes = contact.frame[some].reshape(-1, 3, 3)  # row 0: the normal, geom1 to geom2
    axes[contact.geom1[some] == model.geom("cube").id] *= -1.0
    force = np.einsum("nij,ni->nj", axes, wrench[:, :3])
    return Felt(contact.pos[some], force, axes[:, 0], contact.friction[some, 0])


@contextlib.contextmanager
def silent() -> Iterator[None]:
    """Keep MuJoCo from writing MUJOCO_LOG.TXT; `exploded` reads its counters."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda text: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def exploded(data) -> bool:
    """Return whether the simulation diverged; MuJoCo then resets it silently."""
    return any(data.warning[one].number for one in WARNINGS)


def height(data) -> float:
    """Return the height of the cube's bottom, m; NaN if the simulation diverged."""
    return np.nan if exploded(data) else data.body("cube").xpos[2] - HALF


def lift(
    model,
    data,
    cube: Cube,
    action: Array,
    touch: Callable[[float, Felt], float] | None = None,
    rise: float = RISE,
) -> float:
    """Return the height of a cube at the end of an episode, m; NaN if it diverged.

    `touch` takes the opening and the contacts and returns the next opening; it is
    called every 10 ms as soon as the pads are closed.
    """
    if not np.isfinite(action).all():
        return np.nan
    with silent():
        for _ in episode(model, data, cube, action, touch, rise):
            pass
    return height(data)


def episode(
    model, data, cube: Cube, action: Array, touch=None, rise: float = RISE
) -> Iterator[float]:
    """Run an episode; yield the commanded opening, m, every 10 ms."""
    start(model, data, cube, action)
    opening = action[4]
    for i, (told, closing) in enumerate(zip(*way(action, rise), strict=True)):
        if touch and i * STEP * TICK >= CLOSED:
            opening = touch(opening, felt(model, data))
        pads = OPEN + (opening - OPEN) * closing
        data.ctrl[:] = told, pads, pads
        mujoco.mj_step(model, data, TICK)
        yield opening


def cubes(n: int, rng, mu: tuple[float, float]) -> list[Cube]:
    """Return n random cubes of 50 to 250 g, with friction between two limits."""
    xy = rng.uniform(-0.1, 0.1, (n, 2))
    yaw = rng.uniform(-np.pi, np.pi, n)
    mass = rng.uniform(0.05, 0.25, n)
    return [Cube(*row) for row in np.column_stack([xy, yaw, mass, rng.uniform(*mu, n)])]

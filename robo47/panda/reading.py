"""The Panda's numbers for the formulas, read from a compiled model by name.

MuJoCo is used to read the file (where each body sits on its parent, where each joint
turns), never to compute the answer. Only the seven arm joints, whatever else the
model holds. Units: metres, radians, kilograms; screws are (omega; v).
"""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import kinematics, se3
from robo47.arm import Arm
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.fast.arm_state import as_one
from robo47.fast.vectors import times
from robo47.panda.acting import damper_bit, refuse_unknown
from robo47.panda.loading import ARM_JOINTS
from robo47.screws import screw_axis

# Where the arm ends, by entry: the same point, turned by 180 degrees about z.
ENDS = ("site:attachment_site", "body:hand")


class Inertias(NamedTuple):
    """The masses, centres of mass and inertias of n bodies."""

    masses: Array  # kilograms, (n,)
    coms: Array  # centres of mass in the links' own frames, metres, (n, 3)
    inertias: Array  # about these centres, in the links' axes, kg m^2, (n, 3, 3)

    def carrying(self, carry: Callable[..., Array], *load: Any) -> "Inertias":
        """Return the same bodies, the last one with a load that carry makes part of it.

        Args:
            carry: as `robo47.lifting.combine_bodies`.
            load: mass, com (3,) and inertia (3, 3) in the last body's frame and axes.
        """
        masses, coms, inertias = (part.copy() for part in self)
        ten = carry(masses[-1], coms[-1], inertias[-1], *load)
        xx, yy, zz, xy, xz, yz = ten[4:]
        masses[-1] = ten[0]
        coms[-1] = ten[1:4]
        inertias[-1] = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        return Inertias(masses, coms, inertias)


def joint_ids(model: mujoco.MjModel) -> Array:
    """Return the numbers of joint1 to joint7 in a model, (7,).

    Raises:
        Robo47Error: it has not all of them.
    """
    try:
        return np.array([model.joint(name).id for name in ARM_JOINTS])
    except KeyError:
        raise Robo47Error("the model has no joint1 to joint7; load the Panda") from None


def screws(model: mujoco.MjModel) -> Array:
    """Return the space screws of the seven arm joints, with the arm at q = 0.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        Screws (omega; v), (7, 6): no unit; metres.

    Raises:
        Robo47Error: the model has no joint1 to joint7.
    """
    joints = joint_ids(model)
    T = _poses(model, model.jnt_bodyid[joints], _drawn(model))
    R = T[:, :3, :3]
    p = T[:, :3, 3]
    axes = times(R, model.jnt_axis[joints])
    anchors = times(R, model.jnt_pos[joints])
    return screw_axis(axes, p + anchors) + 0.0  # no -0. where people read it


def home_pose(model: mujoco.MjModel) -> Array:
    """Return M: the pose of the arm's end with every joint at 0.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        T_world_ee, (4, 4): of `attachment_site`, or of `hand` where there is one.

    Raises:
        Robo47Error: the model has neither.
    """
    poses = kinematics.fk_all(model, _drawn(model))
    for frame in ENDS:
        if frame in poses:
            return poses[frame] + 0.0
    raise Robo47Error(f"the model has no {' and no '.join(ENDS)}; load the Panda")


def inertias(model: mujoco.MjModel) -> Inertias:
    """Return the masses, centres of mass and inertias of the seven moving links.

    MuJoCo keeps a link's inertia as three numbers about axes of their own
    (body_inertia, rotated by body_iquat); they are rotated back into the link's
    axes. Never take the file's own numbers: MuJoCo 3.3.0 reproduces them to 5e-7 only.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        (masses (7,), coms (7, 3), inertias (7, 3, 3)). The links alone: what the hand
        of "panda" and "scene" weighs is not in it; `hand_inertia` tells that.

    Raises:
        Robo47Error: the model has no joint1 to joint7.
    """
    links = model.jnt_bodyid[joint_ids(model)]
    return Inertias(
        model.body_mass[links], model.body_ipos[links], _about_coms(model, links)
    )


def hand_inertia(
    model: mujoco.MjModel, opening: float = 0.0
) -> tuple[float, Array, Array]:
    """Return hand and fingers as one body, seen from link 7, which carries them.

    Args:
        model: any entry of `robo47.panda.load`; without a hand all is zero.
        opening: how far each finger is out, metres.

    Returns:
        (mass in kg, com (3,) in link 7's frame in metres, inertia (3, 3) about that
        com in link 7's axes in kg m^2).

    Raises:
        Robo47Error: the model has no joint1 to joint7.
    """
    link7 = int(model.jnt_bodyid[joint_ids(model)[-1]])
    bodies = [b for b in range(model.nbody) if is_descendant(model, b, link7)]
    q = _drawn(model)
    q[model.jnt_qposadr[np.isin(model.jnt_bodyid, bodies)]] = opening
    T_world_link7, *T_world = _poses(model, [link7, *bodies], q)
    T = se3.inverse(T_world_link7) @ np.reshape(T_world, (-1, 4, 4))
    R = T[:, :3, :3]
    p = T[:, :3, 3]
    turned = R @ _about_coms(model, bodies) @ np.swapaxes(R, -1, -2)
    return as_one(
        model.body_mass[bodies], times(R, model.body_ipos[bodies]) + p, turned
    )


def arm(model: mujoco.MjModel) -> Arm:
    """Return the arm, hand included, for loops: see `robo47.arm`.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        The seven links; the last one carries the hand, where there is one, with its
        fingers closed. It ends at `home_pose`.

    Raises:
        Robo47Error: the model has no joint1 to joint7, or something acts on them that
            an `Arm` has no field for: a spring, friction, a fluid, a tendon, ...
    """
    joints = joint_ids(model)
    dofs = model.jnt_dofadr[joints]
    refuse_unknown(model)
    off = model.opt.disableflags
    still = off & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    undamped = off & damper_bit()
    bare = Arm(
        screws(model),
        home_pose(model),
        _poses(model, model.jnt_bodyid[joints], _drawn(model)),
        *inertias(model),
        armature=model.dof_armature[dofs],
        damping=model.dof_damping[dofs] * (0.0 if undamped else 1.0),
        gravity=model.opt.gravity * (0.0 if still else 1.0),
    )
    return bare.carrying(*hand_inertia(model))


def _drawn(model: mujoco.MjModel) -> Array:
    """Return qpos with hinges and slides at 0; a free body where the file has it."""
    q = model.qpos0.copy()
    single = model.jnt_type >= int(mujoco.mjtJoint.mjJNT_SLIDE)
    q[model.jnt_qposadr[single]] = 0.0
    return q


def _about_coms(model: mujoco.MjModel, bodies: list[int]) -> Array:
    """Return R I R^T of each body, (n, 3, 3): in its axes, about its com."""
    R = se3.quat_to_R(model.body_iquat[bodies])
    return (R * model.body_inertia[bodies][:, None, :]) @ np.swapaxes(R, -1, -2)


def is_descendant(model: mujoco.MjModel, body: int, ancestor: int) -> bool:
    """Return whether a body is distal to another one."""
    parent = int(model.body_parentid[body])
    while parent > ancestor:  # MuJoCo numbers parents before their children
        parent = int(model.body_parentid[parent])
    return parent == ancestor


def _poses(model: mujoco.MjModel, bodies: Iterable[int], q: Array) -> Array:
    """Return where bodies are at a configuration, (n, 4, 4)."""
    poses = kinematics.fk_all(model, q)
    return np.array([poses[f"body:{model.body(body).name}"] for body in bodies])

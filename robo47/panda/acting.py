"""Elements that act on the joints of a model and are no part of an `Arm`, by name."""

from collections.abc import Iterator

import mujoco
import numpy as np

from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.panda.loading import ARM_JOINTS

# Names of older and newer versions; a model has those of its own.
_OF_TENDONS = (
    "armature", "stiffness", "stiffnesspoly", "damping", "dampingpoly", "frictionloss"
)  # fmt: skip
_OF_DRIVES = ("armature", "damping", "dampingpoly")


def damper_bit() -> int:
    """Return the flag that switches dampers off; older versions have one for all."""
    bits = mujoco.mjtDisableBit
    names = ("mjDSBL_DAMPER", "mjDSBL_PASSIVE")
    return int(next(getattr(bits, name) for name in names if hasattr(bits, name)))


def refuse_unknown(model: mujoco.MjModel) -> None:
    """Refuse a model in which more acts on the arm than its formulas hold.

    Raises:
        Robo47Error: names what acts.
    """
    if found := list(_unknown(model)):
        raise Robo47Error(
            f"an Arm has no field for {', '.join(found)}, so its torques would be "
            "wrong. Take that out of the model, or ask MuJoCo for the torques"
        )


def _unknown(model: mujoco.MjModel) -> Iterator[str]:
    """Yield what acts on the seven joints and is in no field of an `Arm`."""
    joints = [model.joint(name).id for name in ARM_JOINTS]
    dofs = model.jnt_dofadr[joints]
    moved = _moved(model, joints)
    of_joints = {
        "stiffness": model.jnt_stiffness[joints],
        "frictionloss": model.dof_frictionloss[dofs],
        **{
            name: getattr(model, name)[rows]
            for name, rows in (
                ("jnt_stiffnesspoly", joints), ("dof_dampingpoly", dofs)
            )
            if hasattr(model, name)
        },
    }  # fmt: skip
    for name, values in of_joints.items():
        if np.any(values):
            yield f"the joints' {name}"
    kind = int(mujoco.mjtTrn.mjTRN_JOINT)
    drives = (model.actuator_trntype == kind) & np.isin(
        model.actuator_trnid[:, 0], joints
    )
    for name in _OF_DRIVES:
        values = getattr(model, f"actuator_{name}", None)
        if values is not None and np.any(values[drives]):
            yield f"the actuators' {name}"
    if np.any(model.body_gravcomp[moved]):
        yield "gravcomp"
    if model.opt.density or model.opt.viscosity:
        yield "the fluid (option density or viscosity)"
    yield from _tendons(model, joints, moved)
    yield from _equalities(model, joints, moved)


def _moved(model: mujoco.MjModel, joints: list[int]) -> Array:
    """Return which bodies the arm moves, (nbody,)."""
    moved = np.zeros(model.nbody, dtype=bool)
    moved[model.jnt_bodyid[joints]] = True
    for body in range(1, model.nbody):  # parents come first
        moved[body] |= moved[model.body_parentid[body]]
    return moved


def _tendon_acts(
    model: mujoco.MjModel, tendon: int, joints: list[int], moved: Array
) -> bool:
    """Return whether a tendon's length changes with the arm."""
    start = model.tendon_adr[tendon]
    where = {
        int(mujoco.mjtWrap.mjWRAP_SITE): model.site_bodyid,
        int(mujoco.mjtWrap.mjWRAP_SPHERE): model.geom_bodyid,
        int(mujoco.mjtWrap.mjWRAP_CYLINDER): model.geom_bodyid,
    }
    for k in range(start, start + model.tendon_num[tendon]):
        kind, of = int(model.wrap_type[k]), int(model.wrap_objid[k])
        if kind == int(mujoco.mjtWrap.mjWRAP_JOINT) and of in joints:
            return True
        if kind in where and moved[where[kind][of]]:
            return True
    return False


def _tendons(model: mujoco.MjModel, joints: list[int], moved: Array) -> Iterator[str]:
    for t in range(model.ntendon):
        if not _tendon_acts(model, t, joints, moved):
            continue
        for name in _OF_TENDONS:
            if np.any(getattr(model, f"tendon_{name}", np.zeros(model.ntendon))[t]):
                yield f"the {name} of tendon {model.tendon(t).name!r}"


def _equalities(
    model: mujoco.MjModel, joints: list[int], moved: Array
) -> Iterator[str]:
    kinds = mujoco.mjtEq
    for k in range(model.neq):
        off = model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_EQUALITY)
        if off or not model.eq_active0[k]:
            continue
        kind = int(model.eq_type[k])
        ends = [int(i) for i in (model.eq_obj1id[k], model.eq_obj2id[k]) if i >= 0]
        if kind == int(kinds.mjEQ_JOINT):
            acts = any(i in joints for i in ends)
        elif kind == int(kinds.mjEQ_TENDON):
            acts = any(_tendon_acts(model, i, joints, moved) for i in ends)
        elif kind in (int(kinds.mjEQ_CONNECT), int(kinds.mjEQ_WELD)):
            of_sites = model.eq_objtype[k] == int(mujoco.mjtObj.mjOBJ_SITE)
            acts = any(moved[model.site_bodyid[i] if of_sites else i] for i in ends)
        else:  # a joint of a flexible body
            acts = False
        if acts:
            yield f"the equality {model.eq(k).name or k!r}"

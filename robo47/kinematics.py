"""Forward kinematics by hand: the pose of any frame of any MJCF model.

The model supplies the offset of each body and the axis of each joint. MuJoCo never
computes the result, so the result can be verified with MuJoCo.

The chain from the world to a frame is a product with one factor per link and joint:

    T_world_ee = T_world_link1 @ T(q1) @ T_link1_link2 @ T(q2) @ ... @ T_link7_ee

The factor of a link is fixed; the factor of a joint, with its own axis, is

    hinge   translate to the anchor, rotate by q - ref about the axis, translate back
    slide   translate by q - ref along the axis
    ball    translate to the anchor, rotate by the quaternion q, translate back
    free    the pose (position, quaternion) in q, instead of the body's own offset

(MuJoCo documentation, Computation chapter, "Kinematics").

A frame is named "body:link4"; the bare name is sufficient if only one object has it.
Units: metres, radians, quaternions (w, x, y, z).
"""

from copy import copy
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import se3
from robo47.checks import Array
from robo47.fast.chains import Cursor, Plan, evaluate

_TYPES = ("free", "ball", "slide", "hinge")  # the order is that of mujoco.mjtJoint


@dataclass(frozen=True)
class Joint:
    """One joint of a model.

    Attributes:
        name: its MJCF name, or "joint 3" if it has none.
        type: "hinge", "slide", "ball" or "free".
        axis: unit vector in the body frame, (3,); hinge and slide only.
        anchor: a point on the axis of rotation, in the body frame, metres, (3,).
        ref: the value of q at which the body has the pose of the file.
        qpos_adr: index of its first number in qpos.
    """

    name: str
    type: str
    axis: Array
    anchor: Array
    ref: float
    qpos_adr: int


@dataclass(frozen=True)
class Link:
    """One body: its fixed offset from the parent body, then its joints in order.

    Attributes:
        name: full frame name, "body:link4".
        T_parent_link: pose of the body relative to its parent in the file, (4, 4).
        joints: the joints that move it, in the model's order.
    """

    name: str
    T_parent_link: Array
    joints: tuple[Joint, ...] = ()


@dataclass(frozen=True)
class Chain:
    """The path from the world to a frame, ready for `fk`.

    Attributes:
        frame: full frame name, "site:attachment_site".
        links: the bodies from the world outwards.
        T_link_frame: pose of the frame relative to the last body, (4, 4); the identity
            for a body.
        nq: the number of entries of a configuration of the model.
    """

    frame: str
    links: tuple[Link, ...]
    T_link_frame: Array = field(default_factory=lambda: np.eye(4))
    nq: int = 0

    @cached_property
    def plan(self) -> Plan:
        """The chain as elementary motions, computed once."""
        plan = Plan(self.nq)
        end = Cursor(plan)
        for link in self.links:
            _add_link(end, link)
        end.fixed(self.T_link_frame)
        end.mark(self.frame)
        return plan

    @cached_property
    def plan_of_links(self) -> Plan:
        """The same, with the frame of every link that a joint moves."""
        plan = Plan(self.nq)
        end = Cursor(plan)
        for link in self.links:
            _add_link(end, link)
            if link.joints:
                end.mark(link.name)
        return plan


def chain_to(model: mujoco.MjModel, frame: str) -> Chain:
    """Return the chain from the world to a frame, read from the model.

    Args:
        model: any compiled MJCF model. A mocap body has its pose of the file, and a
            site that of `site_pos`, also if it was changed at run time.
        frame: "body:NAME", "site:NAME", or a name that only one of them has.

    Raises:
        ValueError: no such frame, or a body and a site share the bare name.
    """
    kind, name = _resolve(model, frame)
    if kind == "site":
        site = model.site(name)
        body = int(site.bodyid[0])
        T_link_frame = _offset(site.pos, site.quat)
    else:
        body = model.body(name).id
        T_link_frame = np.eye(4)
    path = []
    while body != 0:  # 0 is the world, the root of every model
        path.append(_link(model, body))
        body = int(model.body_parentid[body])
    return Chain(f"{kind}:{name}", tuple(reversed(path)), T_link_frame, model.nq)


def fk(chain: Chain, qpos: ArrayLike) -> Array:
    """Return the pose of the chain's frame: forward kinematics.

    Many configurations are computed together (`fast.chains`); memory beyond input and
    output does not grow with their number. A single one is computed in plain floats.

    Args:
        chain: from `chain_to`.
        qpos: configurations in MuJoCo's order, (..., nq): radians and metres.

    Returns:
        T_world_frame, (..., 4, 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or a quaternion of norm 0.
    """
    return evaluate(chain.plan, _configurations(qpos, chain.nq))[chain.frame]


def fk_links(chain: Chain, qpos: ArrayLike) -> Array:
    """Return the pose of every link of a chain that a joint moves, base first.

    Args:
        chain: from `chain_to`.
        qpos: configurations in MuJoCo's order, (..., nq): radians and metres.

    Returns:
        T_world_link, (..., links, 4, 4).

    Raises:
        ValueError: as `fk`.
    """
    poses = evaluate(chain.plan_of_links, _configurations(qpos, chain.nq))
    return np.stack([*poses.values()], axis=-3)


def fk_all(model: mujoco.MjModel, qpos: ArrayLike) -> dict[str, Array]:
    """Return the pose of every named body and site, each link computed once.

    Args:
        model: any compiled MJCF model. A mocap body has its pose of the file, and a
            site that of `site_pos`, also if it was changed at run time.
        qpos: configurations, (..., nq).

    Returns:
        {"body:link1": T_world_link1, ..., "site:NAME": ...}, each (..., 4, 4).

    Raises:
        ValueError: as `fk`.
    """
    return evaluate(_plan_all(model), _configurations(qpos, model.nq))


def frame_names(model: mujoco.MjModel) -> list[str]:
    """Return the full name of every named body and site of a model, bodies first."""
    bodies = [model.body(i).name for i in range(model.nbody)]
    sites = [model.site(i).name for i in range(model.nsite)]
    return [f"body:{n}" for n in bodies if n] + [f"site:{n}" for n in sites if n]


def _plan_all(model: mujoco.MjModel) -> Plan:
    """Return one plan for the whole tree; MuJoCo lists parents before children."""
    plan = Plan(model.nq)
    ends = [Cursor(plan)]
    for body in range(model.nbody):
        if body:
            ends.append(copy(ends[model.body_parentid[body]]))
            _add_link(ends[body], _link(model, body))
        if name := model.body(body).name:
            ends[body].mark(f"body:{name}")
    for i in range(model.nsite):
        if name := model.site(i).name:
            end = copy(ends[model.site_bodyid[i]])
            end.fixed(_offset(model.site_pos[i], model.site_quat[i]))
            end.mark(f"site:{name}")
    return plan


def _add_link(end: Cursor, link: Link) -> None:
    """Add one link's factors of the product, from left to right."""
    if not any(joint.type == "free" for joint in link.joints):
        end.fixed(link.T_parent_link)
    for joint in link.joints:
        if joint.type == "slide":
            end.slide(joint.axis, joint.qpos_adr, joint.ref)
        elif joint.type == "free":
            end.free(joint.name, joint.qpos_adr)
        else:
            end.shift(joint.anchor)
            if joint.type == "hinge":
                end.turn(joint.axis, joint.qpos_adr, joint.ref)
            else:
                end.ball(joint.name, joint.qpos_adr)
            end.shift(-joint.anchor)


def _link(model: mujoco.MjModel, body: int) -> Link:
    T = _offset(model.body_pos[body], model.body_quat[body])
    first = int(model.body_jntadr[body])
    joints = range(first, first + int(model.body_jntnum[body]))
    name = f"body:{model.body(body).name}"
    return Link(name, T, tuple(_joint(model, j) for j in joints))


def _joint(model: mujoco.MjModel, j: int) -> Joint:
    adr = int(model.jnt_qposadr[j])
    return Joint(
        name=model.joint(j).name or f"joint {j}",
        type=_TYPES[int(model.jnt_type[j])],
        axis=model.jnt_axis[j].copy(),
        anchor=model.jnt_pos[j].copy(),
        ref=float(model.qpos0[adr]),
        qpos_adr=adr,
    )


def _offset(pos: ArrayLike, quat: ArrayLike) -> Array:
    return se3.make_T(se3.quat_to_R(quat), pos)


def _resolve(model: mujoco.MjModel, frame: str) -> tuple[str, str]:
    """Return (kind, name) of a frame, or raise with the names that do exist."""
    names = frame_names(model)
    matches = [frame] if frame in names else []
    if not matches:  # a bare name, which may itself hold a colon
        matches = [full for full in names if full.partition(":")[2] == frame]
    if len(matches) > 1:
        raise ValueError(f"{frame!r} is a body and a site; say {' or '.join(matches)}")
    if not matches:
        raise ValueError(
            f"no frame {frame!r}; the model has {', '.join(names)} (a URDF's fixed "
            'links are fused, unless <compiler fusestatic="false"/> keeps them)'
        )
    kind, _, name = matches[0].partition(":")
    return kind, name


def _configurations(qpos: ArrayLike, nq: int) -> Array:
    try:
        qpos = np.asarray(qpos, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"qpos is not an array of numbers: {error}") from None
    if qpos.ndim == 0 or qpos.shape[-1] != nq:
        raise ValueError(
            f"qpos has shape {qpos.shape}; expected (..., {nq}): one per q"
        )
    return qpos

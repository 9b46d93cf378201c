"""The Panda's chain: the robots that are asked, and the right product of factors.

    T_world_ee = L0 @ L1 @ J1 @ L2 @ J2 @ ... @ L7 @ J7 @ L8

L_k is where link k sits on the one before it (L8: the flange's `attachment`), J_k what
joint k adds. link0 sits on the world's origin.
"""

from functools import cache, lru_cache, reduce

import numpy as np

from labkit.base.exchange import Path
from labkit.judge import Robot
from labkit.judge.matrices import pose, rigid_inverse
from robo47 import panda, se3, verify
from robo47.checks import Array

NEAR = 1e-4
FLANGE_QUAT = np.array([0.3826834, 0.0, 0.0, 0.9238795])  # as the file rounds it
FLANGE_POS = np.array([0.0, 0.0, 0.107])
PATH = (
    ("link0", None),
    *((f"link{i}", f"joint{i}") for i in range(1, 8)),
    ("attachment", None),
)
# A joint's pose has no translation, so its inverse is its transpose.
BACKWARDS = {"turns-backwards", "R-transposed", "inverse-returned", "T-transposed"}


def _longer(model) -> None:
    """Move link0, lengthen every link and turn one: no number can be typed in."""
    model.body_pos[:] *= 1.2
    model.body_pos[model.body("link0").id] = [0.1, -0.2, 0.3]
    model.body_quat[model.body("link3").id] = [0.6, 0.8, 0.0, 0.0]


PANDA = Robot()
OTHER = Robot(change=_longer)


def on(robot, path=None, count=10):
    """Return inputs on a robot: zero, ready, then random configurations."""

    def inputs(rng):
        drawn = rng.configurations(count)
        some = [np.zeros(7), panda.READY_Q, *drawn] if path is None else drawn
        rest = () if path is None else (Path(path),)
        return [(robot, q, *rest) for q in some]

    return inputs


def by_mujoco(model, q, path=PATH) -> Array:
    """Return the pose of a path's last body as MuJoCo computes it, (4, 4).

    It is relative to the body that carries the path's first one: mostly the world.
    """
    poses = _poses(model, tuple(q))
    body = path[-1][0]
    T = poses["site:attachment_site" if body == "attachment" else f"body:{body}"][0]
    start = model.body(model.body(path[0][0]).parentid[0]).name
    return T if start == "world" else rigid_inverse(poses[f"body:{start}"][0]) @ T


@lru_cache(64)  # mistakes made with a finished pose ask for the same ones
def _poses(model, q):
    fingers = [0.0] * (model.nq - len(q))
    return verify.mujoco_poses(model, np.array([[*q, *fingers]]))


@cache
def link(model, name) -> Array:
    """Return where a body sits on the one before it, (4, 4); do not change it."""
    body = model.body(name)
    return pose(se3.quat_to_R(body.quat), body.pos)


def turn(model, q, joint) -> Array:
    """Return what a joint adds at angles q, (7,): (4, 4), nothing where there is none.

    At angles (n, 7) it is (n, 4, 4).
    """
    if joint is None:
        return np.eye(4)
    return pose(se3.Rz(q[..., model.joint(joint).qposadr[0]]), np.zeros(3))


def steps(model, q, path) -> list[tuple[Array, Array]]:
    """Return (L, J) of every body on a path."""
    return [(link(model, name), turn(model, q, joint)) for name, joint in path]


def product(factors) -> Array:
    """Return the factors multiplied from left to right."""
    return reduce(np.matmul, factors, np.eye(4))


def fk(model, q, path=PATH) -> Array:
    """Return the right product, (4, 4)."""
    return product(factor for step in steps(model, q, path) for factor in step)


def as_written(quat) -> Array:
    """Return a compiled (unit) quaternion as model files write it: (1, -1, 0, 0).

    Somebody who types the numbers off the file meets these.
    """
    scaled = quat / np.abs(quat).max()
    whole = np.round(scaled)
    return whole if np.allclose(scaled, whole) else quat

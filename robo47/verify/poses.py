"""Poses by MuJoCo: what the simulator itself says of every frame.

Units: metres, radians.
"""

from collections.abc import Mapping
from typing import NamedTuple

import mujoco
import numpy as np
from tqdm import tqdm

from robo47.checks import Array
from robo47.kinematics import fk_all, frame_names


class Worst(NamedTuple):
    """The largest difference between two sets of poses, and where it is.

    Attributes:
        error: of the entry that is furthest off.
        frame: its name, "body:link7".
        q: the configuration, (n_q,).
    """

    error: float
    frame: str
    q: Array


def random_q(model: mujoco.MjModel, n: int, seed: int) -> Array:
    """Return random configurations within the joint limits.

    Args:
        model: any model of hinges and slides; an unlimited one turns by up to pi
            (moves by up to 1 m) either way.
        n: how many.
        seed: the same seed gives the same configurations.

    Returns:
        Configurations, (n, nq), uniform in each joint.

    Raises:
        ValueError: the model has a ball or free joint, which has no range.
    """
    if model.nq != model.njnt:
        raise ValueError("the model has a ball or free joint; sample its q yourself")
    hinge = model.jnt_type == int(mujoco.mjtJoint.mjJNT_HINGE)
    reach = np.where(hinge, np.pi, 1.0)
    limited = model.jnt_limited.astype(bool)
    low = np.where(limited, model.jnt_range[:, 0], -reach)
    high = np.where(limited, model.jnt_range[:, 1], reach)
    q = np.empty((n, model.nq))
    q[:, model.jnt_qposadr] = np.random.default_rng(seed).uniform(
        low, high, (n, model.njnt)
    )
    return q


def mujoco_poses(model: mujoco.MjModel, qpos: Array) -> dict[str, Array]:
    """Return every named frame's pose as MuJoCo computes it.

    Args:
        model: any compiled model.
        qpos: configurations, (n, nq).

    Returns:
        {"body:link1": T_world_link1, ...}, each (n, 4, 4), copies.
    """
    data = mujoco.MjData(model)
    # MuJoCo's own arrays, which it fills anew at every call: what is kept is copied.
    theirs = (data.xpos, data.xmat, data.site_xpos, data.site_xmat)
    ours = tuple(np.empty((len(qpos), *array.shape)) for array in theirs)
    for i, q in enumerate(tqdm(qpos, "MuJoCo", leave=False, delay=1, disable=None)):
        data.qpos[:] = q
        # Enough for these four; mj_forward would also compute velocities and forces.
        mujoco.mj_kinematics(model, data)
        for kept, array in zip(ours, theirs, strict=True):
            kept[i] = array
    found, poses = {"body": _poses(*ours[:2]), "site": _poses(*ours[2:])}, {}
    for full in frame_names(model):
        kind, _, name = full.partition(":")
        poses[full] = found[kind][:, getattr(model, kind)(name).id]
    return poses


def mujoco_screws(model: mujoco.MjModel, qpos: Array) -> Array:
    """Return where the axes of all joints are, as screws.

    Args:
        model: any model of hinges.
        qpos: configurations, (n, nq).

    Returns:
        Screws (omega; v) in world axes, (n, njnt, 6).
    """
    data, screws = mujoco.MjData(model), np.empty((len(qpos), model.njnt, 6))
    for S, q in zip(screws, qpos, strict=True):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)  # fills xaxis, and xanchor: a point of it
        S[:] = np.hstack([data.xaxis, np.cross(data.xanchor, data.xaxis)])
    return screws


def mujoco_rotation(axis: Array, theta: float) -> Array:
    """Return the rotation by theta radians about a unit axis, (3,): (3, 3)."""
    quat, R = np.empty(4), np.empty(9)
    mujoco.mju_axisAngle2Quat(quat, axis, theta)
    mujoco.mju_quat2Mat(R, quat)
    return R.reshape(3, 3)


def worst_difference(
    ours: Mapping[str, Array], truth: Mapping[str, Array], qpos: Array
) -> Worst:
    """Return the largest absolute difference of any entry of any pose.

    Args:
        ours: {frame: T, (n, 4, 4)}.
        truth: the same frames.
        qpos: the configurations both were computed at, (n, nq).

    Raises:
        ValueError: they do not have the same frames.
    """
    if ours.keys() != truth.keys():
        raise ValueError(f"not the same frames: {sorted(ours.keys() ^ truth.keys())}")
    worst = Worst(-1.0, "", qpos[:0])
    for frame, T in ours.items():
        error = np.abs(T - truth[frame]).max(axis=(1, 2))
        error = np.where(np.isnan(error), np.inf, error)  # nothing is worse than NaN
        i = int(np.argmax(error))
        if error[i] > worst.error:
            worst = Worst(float(error[i]), frame, qpos[i].copy())
    return worst


def verify_fk(model: mujoco.MjModel, n: int, seed: int) -> Worst:
    """Compare by-hand kinematics with MuJoCo in every named frame.

    Args:
        model: any model of hinges and slides.
        n: number of random configurations within the joint limits.
        seed: of the configurations.

    Returns:
        The worst error (metres for positions, no unit for rotations) and where.
    """
    q = random_q(model, n, seed)
    return worst_difference(fk_all(model, q), mujoco_poses(model, q), q)


def _poses(position: Array, rotation: Array) -> Array:
    """Return poses, (n, m, 4, 4), of positions (n, m, 3) and rotations (n, m, 9)."""
    T = np.zeros((*position.shape[:2], 4, 4))
    T[..., :3, :3] = rotation.reshape(*position.shape, 3)
    T[..., :3, 3] = position
    T[..., 3, 3] = 1.0
    return T

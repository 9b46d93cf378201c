"""MuJoCo as the oracle: its poses, Jacobians, mass matrix, forces and accelerations.

All works from MuJoCo 3.3.0 on: nothing uses mj_fullM, whose arguments changed in 3.10,
nor qM, which 4.0 has no more. Twists are (omega; v) here, as in the rest of the kit;
MuJoCo's own rows are the other way round. Units: metres, radians, kilograms, N m.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike
from tqdm import tqdm

from robo47 import checks, simulate
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.kinematics import fk_all, frame_names

SITE = "attachment_site"  # the last site of the arm without a hand
STEP = 3e-4  # s, of the differences of J: leaves 1e-11


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
        model: any model of hinges and slides; an unlimited one rotates by up to pi
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
    rng = np.random.default_rng(seed)
    q[:, model.jnt_qposadr] = rng.uniform(low, high, (n, model.njnt))
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
    found = {"body": _poses(*ours[:2]), "site": _poses(*ours[2:])}
    poses = {}
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
    data = mujoco.MjData(model)
    screws = np.empty((len(qpos), model.njnt, 6))
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
    off = [np.abs(T - truth[frame]).max(axis=(1, 2)) for frame, T in ours.items()]
    error = np.nan_to_num(off, nan=np.inf, posinf=np.inf)  # nothing is worse than NaN
    frame, i = np.unravel_index(np.argmax(error), error.shape)
    return Worst(float(error[frame, i]), list(ours)[frame], qpos[i].copy())


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


def mujoco_mass_matrix(model: mujoco.MjModel, qpos: ArrayLike) -> Array:
    """Return MuJoCo's mass matrix, armature included.

    Args:
        model: any compiled model.
        qpos: configurations, (..., nq).

    Returns:
        M, (..., nv, nv): M times each unit vector, by mj_mulM.
    """

    def read(data: mujoco.MjData) -> Array:
        mujoco.mj_forward(model, data)
        columns = np.empty((model.nv, model.nv))
        for column, unit in zip(columns, np.eye(model.nv), strict=True):
            mujoco.mj_mulM(model, data, column, unit)
        return columns.T

    return _ask(model, read, qpos=qpos)


def mujoco_bias(model: mujoco.MjModel, qpos: ArrayLike, qvel: ArrayLike) -> Array:
    """Return MuJoCo's torque of Coriolis, centrifugal and gravity forces.

    Args:
        model: any compiled model.
        qpos: configurations, (..., nq).
        qvel: joint velocities, rad/s, (..., nv).

    Returns:
        qfrc_bias, N m, (..., nv). Damping is not in it.
    """
    return _after(mujoco.mj_forward, "qfrc_bias", model, qpos=qpos, qvel=qvel)


def mujoco_inverse_dynamics(
    model: mujoco.MjModel, qpos: ArrayLike, qvel: ArrayLike, qacc: ArrayLike
) -> Array:
    """Return the torque that MuJoCo finds for an acceleration, by mj_inverse.

    Args:
        model, qpos, qvel: as in `mujoco_bias`.
        qacc: joint accelerations, rad/s^2, (..., nv).

    Returns:
        qfrc_inverse, N m, (..., nv), with armature and damping: mj_rne has neither.
    """
    state = {"qpos": qpos, "qvel": qvel, "qacc": qacc}
    return _after(mujoco.mj_inverse, "qfrc_inverse", model, **state)


def mujoco_acceleration(
    model: mujoco.MjModel, qpos: ArrayLike, qvel: ArrayLike, ctrl: ArrayLike
) -> Array:
    """Return the acceleration that MuJoCo finds for what the motors do.

    Args:
        model: any compiled model; with `drive="torque"` ctrl is a torque.
        qpos: configurations, (..., nq).
        qvel: joint velocities, rad/s, (..., nv).
        ctrl: of the motors, (..., nu).

    Returns:
        qacc of mj_forward, rad/s^2, (..., nv).
    """
    return _after(mujoco.mj_forward, "qacc", model, qpos=qpos, qvel=qvel, ctrl=ctrl)


def mujoco_step(
    model: mujoco.MjModel, qpos: ArrayLike, qvel: ArrayLike, ctrl: ArrayLike
) -> Array:
    """Return the joint velocities one simulation step later, by mj_step.

    Args:
        model, qpos, qvel, ctrl: as in `mujoco_acceleration`.

    Returns:
        qvel, rad/s, (..., nv).
    """
    return _after(mujoco.mj_step, "qvel", model, qpos=qpos, qvel=qvel, ctrl=ctrl)


def mujoco_site_jacobian(
    model: mujoco.MjModel, qpos: ArrayLike, site: str = SITE
) -> Array:
    """Return MuJoCo's Jacobian of a site, as twists (omega; v).

    Args:
        model: any compiled model.
        qpos: configurations, (..., nq).
        site: its MJCF name.

    Returns:
        J_site, (..., 6, nv): angular velocity, then the velocity of the site's point,
        both in world axes.

    Raises:
        Robo47Error: the model has no such site.
    """
    number = _site(model, site)

    def read(data: mujoco.MjData) -> Array:
        # mj_jacSite reads cdof, which mj_comPos fills: without it J is zero or old.
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        J = np.zeros((2, 3, model.nv))
        mujoco.mj_jacSite(model, data, J[1], J[0], number)  # v first, then omega
        return J.reshape(6, model.nv)

    return _ask(model, read, qpos=qpos)


def mujoco_bias_acceleration(
    model: mujoco.MjModel, q: ArrayLike, qd: ArrayLike
) -> Array:
    """Return the rate of MuJoCo's site Jacobian times qd, from differences of it.

    MuJoCo's own mj_jacDot is not used: in 3.3.0 its linear rows are wrong.

    Args:
        model: the arm without a hand.
        q: configuration in radians, (7,).
        qd: joint velocities in rad/s, one number or (7,).

    Returns:
        The hand's acceleration at qdd = 0 in rad/s2 and m/s2, (6,), to about 1e-11.
    """
    q = checks.array(q, "q", (7,))
    qd = np.broadcast_to(checks.per_joint(qd, "qd", q), 7)
    J = mujoco_site_jacobian(model, q + np.outer(STEP * np.array([-2, -1, 1, 2]), qd))
    return (J[0] - 8.0 * J[1] + 8.0 * J[2] - J[3]) @ qd / (12.0 * STEP)


def mujoco_external_torque(
    model: mujoco.MjModel, qpos: ArrayLike, wrench: ArrayLike
) -> Array:
    """Return the joint torques that MuJoCo puts in the place of a wrench at the hand.

    Args:
        model: any compiled model.
        qpos: configurations, (n, nq).
        wrench: moment about `attachment_site` and force, world axes, (n, 6).

    Returns:
        Torques by mj_applyFT, N m, (n, nv).

    Raises:
        Robo47Error: the model has no such site.
    """
    _site(model, SITE)
    data = mujoco.MjData(model)
    answers = []
    for q, F in zip(np.asarray(qpos), np.asarray(wrench), strict=True):
        data.qpos[:] = q
        data.qfrc_applied[:] = 0.0
        simulate.push_at(SITE, F)(model, data)
        answers.append(data.qfrc_applied.copy())
    return np.array(answers)


def _site(model: mujoco.MjModel, site: str) -> int:
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, site)
    if number < 0:
        raise Robo47Error(f"the model has no site {site!r}; load panda_nohand")
    return int(number)


def _after(
    function: Callable[[mujoco.MjModel, mujoco.MjData], None],
    name: str,
    model: mujoco.MjModel,
    **state: ArrayLike,
) -> Array:
    """Return what `data` holds under a name after one of MuJoCo's functions."""

    def read(data: mujoco.MjData) -> Array:
        function(model, data)
        return getattr(data, name)

    return _ask(model, read, **state)


def _ask(
    model: mujoco.MjModel, read: Callable[[mujoco.MjData], Array], **state: ArrayLike
) -> Array:
    """Return what `read` reads at every state, each set on data that is like new."""
    given = {name: np.asarray(value, dtype=np.float64) for name, value in state.items()}
    batch = np.broadcast_shapes(*(value.shape[:-1] for value in given.values()))
    for name, value in given.items():
        given[name] = np.broadcast_to(value, (*batch, value.shape[-1]))
    data = mujoco.MjData(model)
    answers = []
    for index in np.ndindex(batch):
        mujoco.mj_resetData(model, data)
        for name, value in given.items():
            getattr(data, name)[:] = value[index]
        answers.append(read(data).copy())
    return np.array(answers).reshape(*batch, *answers[0].shape)


def _poses(position: Array, rotation: Array) -> Array:
    """Return poses, (n, m, 4, 4), of positions (n, m, 3) and rotations (n, m, 9)."""
    T = np.zeros((*position.shape[:2], 4, 4))
    T[..., :3, :3] = rotation.reshape(*position.shape, 3)
    T[..., :3, 3] = position
    T[..., 3, 3] = 1.0
    return T

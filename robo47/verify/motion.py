"""MuJoCo as the oracle of motion: its mass matrix, forces, accelerations, Jacobians.

Every function takes one configuration or many, and works from MuJoCo 3.3.0 on: none
uses mj_fullM, whose arguments changed in 3.10, nor qM, which 4.0 has no more. Twists
are (omega; v) here, as in the rest of the kit; MuJoCo's own rows are the other way
round. Units: metres, radians, kilograms, N m.
"""

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import simulate
from robo47.checks import Array
from robo47.errors import Robo47Error

SITE = "attachment_site"  # where the arm without a hand ends


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


def mujoco_push(model: mujoco.MjModel, qpos: ArrayLike, wrench: ArrayLike) -> Array:
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
    data, answers = mujoco.MjData(model), []
    for q, F in zip(np.asarray(qpos), np.asarray(wrench), strict=True):
        data.qpos[:], data.qfrc_applied[:] = q, 0.0
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

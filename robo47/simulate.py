"""Run a controller in the simulator, at a rate of its own, and record the motion.

The controller is a function of (t, q, qd) that returns `ctrl`: torques for the seven
joints of a model loaded with drive="torque" (N m), optionally followed by numbers for
further actuators. It receives the measured q and qd of joint1 to joint7 and nothing
else: after mj_step MuJoCo's positions of bodies and sites are one step old, so the
controller must compute its own.

Units: seconds, radians, rad/s, N m.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.panda.reading import joint_ids

Controller = Callable[[float, Array, Array], ArrayLike]
Watcher = Callable[[mujoco.MjModel, mujoco.MjData], Any]
Push = Callable[[mujoco.MjModel, mujoco.MjData], None]

RATE = 250.0  # Hz, of the controller; 100 still works for gains of omega = 20

# The Panda's own limits, which its model file does not contain (Franka, FCI
# documentation, "Robot and interface specifications"): rad/s and rad/s2 of joint1 to
# joint7.
SPEED_LIMITS = np.array([2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61])
ACC_LIMITS = np.array([15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0])


class Run(NamedTuple):
    """The record of a run. The N + 1 states are those at the control instants.

    Attributes:
        t: seconds since the run began, (N + 1,).
        q: measured configurations in radians, (N + 1, 7).
        qd: measured velocities in rad/s, (N + 1, 7).
        tau: commanded torques of the seven motors from each instant to the next, before
            saturation, (N, 7).
        seen: the results of `watch` after each control period, N of them.
    """

    t: Array
    q: Array
    qd: Array
    tau: Array
    seen: list[Any]


def start(model: mujoco.MjModel, q: ArrayLike, qd: ArrayLike = 0.0) -> mujoco.MjData:
    """Return the simulator's state with the arm at q, all else as in the key `home`.

    Args:
        model: any Panda of `robo47.panda.load` or `robo47.scenes`.
        q: configuration of the seven joints in radians, (7,).
        qd: their velocities in rad/s, one number or (7,).

    Returns:
        New data, with mj_forward called; ctrl of the seven is 0.

    Raises:
        ValueError: wrong shape or a non-finite number.
        Robo47Error: the model has no joint1 to joint7.
    """
    q = checks.array(q, "q", (7,))
    qd = checks.per_joint(qd, "qd", q)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    adr, dof, motors = addresses(model)
    data.qpos[adr] = q
    data.qvel[dof] = qd
    data.ctrl[motors] = 0.0
    mujoco.mj_forward(model, data)
    return data


def addresses(model: mujoco.MjModel) -> tuple[Array, Array, Array]:
    """Return the indices of the seven joints in qpos, qvel and ctrl, found by name.

    Args:
        model: any Panda.

    Returns:
        Three arrays of indices, each (7,).

    Raises:
        Robo47Error: the model has no joint1 to joint7, or no actuator on one.
    """
    ids = joint_ids(model)
    on_joint = model.actuator_trntype == int(mujoco.mjtTrn.mjTRN_JOINT)
    target = np.where(on_joint, model.actuator_trnid[:, 0], -1)
    found = [np.flatnonzero(target == j) for j in ids]
    if any(len(motors) != 1 for motors in found):
        raise Robo47Error("each of joint1 to joint7 needs one actuator; load the Panda")
    return model.jnt_qposadr[ids], model.jnt_dofadr[ids], np.concatenate(found)


def limits(model: mujoco.MjModel) -> tuple[Array, Array]:
    """Return the ranges of the seven joints and the torque limits of their drives.

    Args:
        model: any Panda.

    Returns:
        Ranges in radians, (7, 2), and torques in N m, (7,): 87 and 12.
    """
    motors = addresses(model)[2]
    ranges = model.jnt_range[joint_ids(model)]
    return ranges, model.actuator_forcerange[motors, 1]


def run(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    controller: Controller,
    seconds: float,
    *,
    rate: float = RATE,
    push: Push | None = None,
    watch: Watcher | None = None,
) -> Run:
    """Simulate a controller from the state in `data`, which is advanced to the end.

    Args:
        model: a Panda.
        data: its state; `start` makes one.
        controller: maps (t, q, qd) to ctrl, from the first actuator on.
        seconds: duration, a whole number of control periods.
        rate: of the controller in Hz; a period is a whole number of time steps.
        push: is called before every time step and may write data.qfrc_applied, which is
            zero before; `push_at` makes one.
        watch: is called after every control period; read nothing but qpos and qvel of
            its arguments, or call mj_forward on a copy first.

    Returns:
        The record.

    Raises:
        ValueError: the period is not a whole number of steps, or the controller
            returned something that is no torque.
    """
    steps = steps_per_period(model, rate)
    adr, dof, _ = addresses(model)
    n = round(seconds * rate)
    q = np.empty((n + 1, 7))
    qd = np.empty((n + 1, 7))
    tau = np.empty((n, 7))
    seen: list[Any] = []
    for k in range(n + 1):
        q[k] = data.qpos[adr]
        qd[k] = data.qvel[dof]
        if k == n:
            break
        ctrl = np.asarray(controller(k / rate, q[k].copy(), qd[k].copy()), float)
        if ctrl.ndim != 1 or not 7 <= len(ctrl) <= model.nu or np.isnan(ctrl).any():
            raise ValueError(f"the controller returned {ctrl}; expected 7 torques")
        data.ctrl[: len(ctrl)] = ctrl
        tau[k] = ctrl[:7]
        _advance(model, data, steps, push)
        if watch is not None:
            seen.append(watch(model, data))
    return Run(np.arange(n + 1) / rate, q, qd, tau, seen)


def push_at(site: str, wrench: ArrayLike) -> Push:
    """Return a push with a constant wrench at a site, for `run`.

    It uses mj_applyFT at the site. xfrc_applied would act at the body's centre of
    mass, which for `attachment` lies 0.107 m beyond the site.

    Args:
        site: its name.
        wrench: (moment; force) in the world frame, N m and N, (6,).
    """
    wrench = checks.array(wrench, "wrench", (6,))

    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        mujoco.mj_kinematics(model, data)  # site_xpos is one step old
        mujoco.mj_comPos(model, data)  # mj_applyFT takes the Jacobian from it
        point = data.site(site).xpos
        body = int(model.site(site).bodyid[0])
        moment = wrench[:3]
        force = wrench[3:]
        mujoco.mj_applyFT(model, data, force, moment, point, body, data.qfrc_applied)

    return push


def steps_per_period(model: mujoco.MjModel, rate: float) -> int:
    """Return the number of time steps in a control period.

    Args:
        model: of which the time step is used.
        rate: of the controller in Hz.

    Raises:
        ValueError: it is not a whole number.
    """
    exact = 1.0 / (float(checks.positive(rate, "rate")) * model.opt.timestep)
    if abs(exact - round(exact)) > 1e-6 or round(exact) < 1:
        raise ValueError(
            f"rate {rate:g} Hz is {exact:.3g} time steps of {model.opt.timestep:g} s;"
            " it must be a whole number of them (500, 250, 100 Hz, ...)"
        )
    return round(exact)


def _advance(
    model: mujoco.MjModel, data: mujoco.MjData, steps: int, push: Push | None
) -> None:
    if push is None:
        mujoco.mj_step(model, data, steps)
        return
    for _ in range(steps):
        data.qfrc_applied[:] = 0.0
        push(model, data)
        mujoco.mj_step(model, data)
    data.qfrc_applied[:] = 0.0

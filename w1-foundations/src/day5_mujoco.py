"""Day 5's simulations in MuJoCo: motors, servos, and the stability limit of a loop.

A law is a function of (arm, q, qd, reference at this instant) that returns torques. A
reference is one of `robo47.references`. Radians, rad/s, N m, seconds.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import panda, simulate
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.references import Reference
from robo47.verify import random_q

Law = Callable[..., Array]


class States(NamedTuple):
    """Random states of the arm and inputs of a controller, (n, 7) each."""

    q: Array  # joint angles, rad
    qd: Array  # joint velocities, rad/s
    e: Array  # errors, reference minus measurement, rad
    ed: Array  # rates of the errors, rad/s
    qdd_ref: Array  # acceleration of the reference, rad/s^2


class Servos(NamedTuple):
    """The gains of the model file's position servos, (7,) each."""

    kp: Array  # N m/rad
    kd: Array  # N m s/rad


def motors(
    drive: str = "torque",
    integrator: str = "mjINT_IMPLICITFAST",
    edit: Callable[[mujoco.MjSpec], None] | None = None,
) -> mujoco.MjModel:
    """Return the arm with one of its drives and one of MuJoCo's integrators.

    Args:
        drive: "torque" or "servo".
        integrator: its name in `mujoco.mjtIntegrator`.
        edit: changes the model, as in `panda.load`.
    """
    model = panda.load("panda_nohand", drive=drive, edit=edit)
    model.opt.integrator = getattr(mujoco.mjtIntegrator, integrator)
    return model


def states(model: mujoco.MjModel, n: int, seed: int) -> States:
    """Return n random states: q within the joint limits, the others within +-1."""
    qd, e, ed, qdd = np.random.default_rng(seed).uniform(-1, 1, (4, n, 7))
    return States(random_q(model, n, seed), qd, e, ed, qdd)


def arguments(at: States, seed: int) -> dict[str, tuple[Array, ...]]:
    """Return {function: arguments}, (n, ...) each, for those that MuJoCo lacks."""
    rng = np.random.default_rng([seed, 5])
    n = len(at.q)
    K, D = rng.uniform(10, 100, (2, n, 7))
    times = np.tile(np.linspace(0, 0.5, 26), (n, 1))
    omega = rng.uniform(2, 30, n)
    zeta = np.resize([0.3, 0.7, 1.0, 1.5], n)
    clamp = np.resize([0.005, 0.2, 10], n)
    pid = np.tile([400.0, 40.0, 3000.0, 0.01], (n, 1)).T
    return {
        "pd_torque": (at.e, at.ed, K, D),
        "pd_gains": (omega, zeta),
        "error_response": (times, omega, zeta),
        "pd_equilibrium_step": (at.q, 50 * at.e, K),
        "gravity_pd": (at.e, at.ed, K, D, 50 * at.qd),
        "pid_step": (at.e, at.ed, 0.2 * at.qd, *pid, clamp),
        "saturate": (150 * at.e, np.abs(100 * at.ed)),
    }


def servos_follow(reference: Reference, seconds: float) -> simulate.Run:
    """Return a run of the model file's own position servos along a reference."""
    model = panda.load("panda_nohand")  # drive="servo": ctrl takes angles
    data = simulate.start(model, READY_Q)
    return simulate.run(model, data, lambda t, q, qd: reference(t)[0], seconds)


def servos_of(model: mujoco.MjModel) -> Servos:
    """Return the gains of a model's servos, from MuJoCo's actuator parameters."""
    return Servos(model.actuator_gainprm[:, 0], -model.actuator_biasprm[:, 2])


def breaking(
    model: mujoco.MjModel, law_of: Callable[[float], Law], rate: float, start: Array
) -> float:
    """Return the smallest omega at which a tiny error grows, found by bisection.

    Args:
        model: of the arm, with motors.
        law_of: returns the law of an omega.
        rate: of the controller, Hz.
        start: joint angles so close to READY_Q that no motor reaches its limit within
            60 periods, rad, (7,).

    Returns:
        omega, rad/s, to within 0.1.
    """
    low = 0.75 * rate
    high = 1.05 * rate
    arm = panda.arm(model)
    goal = READY_Q, np.zeros(7), np.zeros(7)
    while high - low > 0.1:
        omega = (low + high) / 2
        law = law_of(omega)

        def loop(t: float, q: Array, qd: Array, law: Any = law) -> Array:
            return law(arm, q, qd, goal)

        run = simulate.run(
            model, simulate.start(model, start), loop, 60 / rate, rate=rate
        )
        e = np.abs(run.q - READY_Q)
        if e[-10:].max() > e[20:30].max():
            high = omega
        else:
            low = omega
    return (low + high) / 2

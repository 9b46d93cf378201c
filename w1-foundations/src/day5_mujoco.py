"""Control laws, given by a lab, against MuJoCo and the library: values, and whole runs.

A law is a function of (arm, q, qd, reference at this instant) that returns torques; a
reference one of `robo47.references`. Radians, rad/s, N m, seconds.
"""

from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import numpy as np

from robo47 import control, panda, simulate
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.references import Reference
from robo47.verify.answers import Check, Function, each
from robo47.verify.oracle import mujoco_inverse_dynamics, random_q

Law = Function


def compare(check: Check, own: Mapping[str, Any], n: int, seed: int) -> None:
    """Check computed torque against mj_inverse, the others against the library's.

    Args:
        check: is given the name of each function, and its differences.
        own: functions by their names in `robo47.control`: a lab's globals().
        n: on how many random states.
        seed: of the states.
    """
    rng = np.random.default_rng(seed)
    model = panda.load("panda_nohand", drive="torque")
    q = random_q(model, n, seed)
    arm = panda.arm(model)
    qd, e, ed, qdd = rng.uniform(-1, 1, (4, n, 7))
    kp, kd = 400.0, 28.0  # omega 20, zeta 0.7
    tau = []
    for i, now in enumerate(map(arm.at, q)):
        known = now.M, now.bias(qd[i]), arm.damping, qd[i]
        springs = e[i], ed[i], qdd[i], kp, kd
        tau.append(own["computed_torque"](*known, *springs))
    truth = mujoco_inverse_dynamics(model, q, qd, qdd + kp * e + kd * ed)
    check("computed_torque - MuJoCo's mj_inverse, N m", np.array(tau) - truth)
    print("  the library robo47.control instead of MuJoCo:")
    for name, columns in _columns(rng, q, qd, e, ed).items():
        check(name, each(own[name], *columns) - each(getattr(control, name), *columns))


def motors(
    drive: str = "torque",
    integrator: str = "mjINT_IMPLICITFAST",
    edit: Callable[[mujoco.MjSpec], None] | None = None,
) -> mujoco.MjModel:
    """Return the arm with one of its drives and one of MuJoCo's integrators.

    Args:
        drive: "torque" or "servo".
        integrator: by its name in `mujoco.mjtIntegrator`.
        edit: of the model, as `panda.load` takes it.
    """
    model = panda.load("panda_nohand", drive=drive, edit=edit)
    model.opt.integrator = getattr(mujoco.mjtIntegrator, integrator)
    return model


def rest(
    sag_step: Function, q_goal: Array, load: Callable[[Array], Array], kp: Any
) -> Array:
    """Return where sag_step stays when it is asked 100 times, at its own answer."""
    q = q_goal
    for _ in range(100):
        q = sag_step(q_goal, load(q), kp)
    return q


def tracking(log: simulate.Run, reference: Reference) -> Array:
    """Return how far each joint is from a reference at every instant, mrad, (N, 7)."""
    return 1e3 * np.abs(log.q - np.array([reference(t)[0] for t in log.t]))


def by_servos(reference: Reference, seconds: float) -> simulate.Run:
    """Return how the model file's own position servos follow a reference."""
    model = panda.load("panda_nohand")
    data = simulate.start(model, READY_Q)
    return simulate.run(model, data, lambda t, q, qd: reference(t)[0], seconds)


def breaking(
    model: mujoco.MjModel, law_of: Callable[[float], Law], rate: float, start: Array
) -> float:
    """Return the omega from which a tiny error grows, found by halving an interval.

    Args:
        model: of the arm, with motors.
        law_of: the law of an omega.
        rate: of the controller in Hz.
        start: a hair's breadth from ready: no motor is at its limit before 60 torques.
    """
    low = 0.75 * rate
    high = 1.05 * rate
    arm = panda.arm(model)
    goal = READY_Q, np.zeros(7), np.zeros(7)
    while high - low > 0.1:
        omega = (low + high) / 2
        law = law_of(omega)
        data = simulate.start(model, start)
        loop = lambda t, q, qd, law=law: law(arm, q, qd, goal)  # noqa: E731
        e = np.abs(simulate.run(model, data, loop, 60 / rate, rate=rate).q - READY_Q)
        grows = e[-10:].max() > e[20:30].max()
        low, high = (low, omega) if grows else (omega, high)
    return (low + high) / 2


def compare_breaking(
    lab: Any,
    model: mujoco.MjModel,
    law_of: Callable[[float], Law],
    stiffest_omega: Callable[..., Any],
    rate: float,
    start: Array,
) -> None:
    """Check where a loop breaks: with a torque every step, then at another rate.

    Args:
        lab: prints and checks.
        model, law_of, start: as `breaking` has them.
        stiffest_omega: predicts it for a torque every step; the library's for the rate.
        rate: in Hz.
    """
    h = model.opt.timestep
    n = simulate.steps_per_period(model, rate)
    for every, limit, whose in (
        (1, stiffest_omega(h), "largest omega"),
        (n, control.stiffest_omega(h, n), f"the library's, at the day's {rate:g} Hz"),
    ):
        found = breaking(model, law_of, 1 / (every * h), start)
        what = f"torque every {1e3 * every * h:g} ms, loop breaks at"
        lab.predict(what, limit, found, "rad/s")
        lab.check(f"{whose}, rad/s", limit - found, limit=2.0)


def servo_torque(servo_ctrl: Function) -> Array:
    """Return the torque of MuJoCo's servos minus the one asked for, N m, (7,)."""
    model = panda.load("panda_nohand")
    tau = np.array([5.0, -20, 3, 15, 1, 2, -1])
    data = simulate.start(model, READY_Q, [0.1, -0.1] * 3 + [0.1])
    data.ctrl[:] = servo_ctrl(tau, data.qpos, data.qvel, *_gains(model))
    mujoco.mj_forward(model, data)  # the force now; mj_step would move on
    return data.actuator_force - tau


def through_servos(law: Law, servo_ctrl: Function, reference: Reference) -> float:
    """Return how far off servos are that are commanded torques, at 500 Hz, in mrad."""
    model = panda.load("panda_nohand")
    arm = panda.arm(model)
    data = simulate.start(model, READY_Q)

    def inverted(t: float, q: Array, qd: Array) -> Array:
        return servo_ctrl(law(arm, q, qd, reference(t)), q, qd, *_gains(model))

    log = simulate.run(model, data, inverted, 2.0, rate=500)  # at 250: 94 mrad
    return float(tracking(log, reference).max())


def _gains(model: mujoco.MjModel) -> tuple[Array, Array]:
    """Return the servos' kp and kd."""
    return model.actuator_gainprm[:, 0], -model.actuator_biasprm[:, 2]


def _columns(
    rng: np.random.Generator, q: Array, qd: Array, e: Array, ed: Array
) -> dict[str, tuple[Array, ...]]:
    """Return random arguments of each function, (n, ...) each."""
    n = len(q)
    K, D = rng.uniform(10, 100, (2, n, 7))
    times = np.tile(np.linspace(0, 0.5, 26), (n, 1))
    omega = rng.uniform(2, 30, n)
    zeta = np.resize([0.3, 0.7, 1.0, 1.5], n)
    clamp = np.resize([0.005, 0.2, 10], n)
    pid = np.tile([400.0, 40.0, 3000.0, 0.01], (n, 1)).T
    return {
        "pd_torque": (e, ed, K, D),
        "gains": (omega, zeta),
        "error_response": (times, omega, zeta),
        "sag_step": (q, 50 * e, K),
        "gravity_pd": (e, ed, K, D, 50 * qd),
        "pid_step": (e, ed, 0.2 * qd, *pid, clamp),
        "saturate": (150 * e, np.abs(100 * ed)),
    }

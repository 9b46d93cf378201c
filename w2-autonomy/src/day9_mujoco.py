"""Day 9's simulations: an arm that moves or holds, with late readings or a push.

Radians, seconds, newtons, N m.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import simulate
from robo47.arm import Arm
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.references import Reference, hold, raised_cosine

OMEGA, RATE = 20.0, 500.0  # 1/s, of the PD gains; Hz, of encoders and control
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])  # rad, of Day 5's swing
LISTEN = 0.06  # s, from detecting a contact to naming a link: three times 1 / gain
SMALL = 1e-4  # rad, an error too small to bring a motor to its limit
FLANGE = "attachment_site"
STAY = hold(READY_Q)
SWING = raised_cosine(READY_Q, REACH)


def tracking(arm: Arm, reference: Reference) -> simulate.Controller:
    """Return Day 5's computed torque, critically damped."""

    def law(t: float, q: Array, qd: Array) -> Array:
        to, to_d, to_dd = reference(t)
        now = arm.at(q)
        pull = OMEGA**2 * (to - q) + 2.0 * OMEGA * (to_d - qd)
        return now.M @ (to_dd + pull) + now.bias(qd) + arm.damping * qd

    return law


def moved(
    model: mujoco.MjModel, arm: Arm, reference: Reference, seconds: float,
    push: simulate.Push | None = None,
) -> simulate.Run:  # fmt: skip
    """Return the run of an arm that follows a reference from ready, pushed or not."""
    data = simulate.start(model, READY_Q)
    law = tracking(arm, reference)
    return simulate.run(model, data, law, seconds, rate=RATE, push=push)


def push(name: str, force: ArrayLike, since: float) -> simulate.Push:
    """Return a push by a force (3,), N, world frame, at a link's centre or a site."""

    def apply(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        if data.time > since - 1e-9:
            mujoco.mj_kinematics(model, data)  # positions are one step old
            mujoco.mj_comPos(model, data)  # for the Jacobian of mj_applyFT
            torque_of(model, data, name, force)

    return apply


def torque_of(
    model: mujoco.MjModel, data: mujoco.MjData, name: str, force: ArrayLike
) -> None:
    """Add the joint torques J^T F of a force to qfrc_applied, N m."""
    if name == FLANGE:
        body, point = int(model.site(name).bodyid[0]), data.site(name).xpos
    else:
        body, point = model.body(name).id, data.body(name).xipos
    force = np.array(force, dtype=float)
    mujoco.mj_applyFT(model, data, force, np.zeros(3), point, body, data.qfrc_applied)


def left_over(
    model: mujoco.MjModel, arm: Arm, late: float, omega: float, rate: float = RATE
) -> float:
    """Return the fraction of an error that is left after 2 s of late readings.

    Every joint starts SMALL away from ready, and the PD terms use readings that are
    `late` seconds old. Gravity and damping are compensated without a delay.

    Args:
        model: with motors.
        arm: the same arm.
        late: s, a whole number of control periods.
        omega: 1/s, of the critically damped PD gains.
        rate: of the control, Hz.
    """
    M = arm.at(READY_Q).M
    heard: list[tuple[Array, Array]] = []

    def law(t: float, q: Array, qd: Array) -> Array:
        heard.append((q, qd))
        q_late, qd_late = heard[max(len(heard) - 1 - round(late * rate), 0)]
        pull = omega**2 * (READY_Q - q_late) - 2.0 * omega * qd_late
        return M @ pull + arm.at(q).bias(qd) + arm.damping * qd

    data = simulate.start(model, READY_Q + SMALL)
    run = simulate.run(model, data, law, 2.0, rate=rate)  # mujoco.mj_step
    last = run.q[-round(0.2 * rate) :]
    return float(np.abs(last - READY_Q).max()) / SMALL


class Stop(NamedTuple):
    """How an arm stopped after a contact during its swing."""

    link: int  # the contact link that it names; 0 if it detected nothing
    t: float  # time of the detection, s
    moves_on: float  # from the flange's position at the detection to its last, mm


def stopped(
    model: mujoco.MjModel, arm: Arm, observer: Any, link_of: Callable[[Array], int],
    push: simulate.Push, seconds: float = 0.6,
) -> Stop:  # fmt: skip
    """Let the arm swing until it detects a contact, then hold its position.

    Args:
        model, arm: the same arm.
        observer: has `feel` and `commanded`, as the lab's.
        link_of: maps a residual, N m, (7,), to the contact link, or 0.
        push: the external force, by `push`.
        seconds: of the whole simulation.
    """
    named = 0
    found: list[tuple[float, Array]] = []

    def law(t: float, q: Array, qd: Array) -> Array:
        nonlocal named
        now = arm.at(q)
        link = link_of(observer.feel(now, qd))
        if link and not found:
            found.append((t, q))
        if found and t <= found[0][0] + LISTEN:
            named = link
        reference = hold(found[0][1]) if found else SWING
        tau = tracking(arm, reference)(t, q, qd)
        observer.commanded(now, qd, tau)
        return tau

    data = simulate.start(model, READY_Q)
    run = simulate.run(model, data, law, seconds, rate=RATE, push=push)
    if not found:
        return Stop(0, np.inf, np.inf)
    t, q = found[0]
    way = arm.at(run.q[-1]).T_world_ee - arm.at(q).T_world_ee
    return Stop(named, t, 1000.0 * float(np.linalg.norm(way[:3, 3])))

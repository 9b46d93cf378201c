"""MuJoCo's hand under what a lab's own functions say, at random states of the arm.

Each comparison is given the states and the functions that it compares, and returns one
row of differences a state. Twists, accelerations and wrenches have the rotation first,
in world axes at the hand's site; J is the site Jacobian. SI units.
"""

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import contact, jacobian, panda, simulate, task_space
from robo47.checks import Array
from robo47.fast.arm_state import ArmState
from robo47.panda import READY_Q
from robo47.verify.answers import Check, Function, each
from robo47.verify.oracle import mujoco_site_jacobian, random_q


class State(NamedTuple):
    """A random state of the arm, and random things to ask of it."""

    now: ArmState  # the arm at its configuration
    qd: Array  # joint velocities in rad/s, (7,)
    torque: Array  # of the joints in N m, (7,)
    wrench: Array  # at the hand, (6,), to push with
    acc: Array  # at the hand, (6,), to ask for
    e: Array  # at the hand, (6,), to be off by


def states(model: mujoco.MjModel, n: int, seed: int, sigma: float) -> list[State]:
    """Return up to n states where J's least singular value is over sigma."""
    arm = panda.arm(model)
    rng = np.random.default_rng(seed)
    q = random_q(model, 2 * n, seed)
    found = []
    least = np.linalg.svd(mujoco_site_jacobian(model, q), compute_uv=False)[:, -1]
    for one in q[least > sigma][:n]:
        qd, torque = rng.uniform(-1, 1, (2, 7)) * [[1], [10]]
        found.append(State(arm.at(one), qd, torque, *rng.uniform(-10, 10, (3, 6))))
    return found


def mass_felt(
    model: mujoco.MjModel, found: Sequence[State], task_inertia: Function
) -> Array:
    """Return Lambda a - F of MuJoCo's hand at rest, as a part of its push F, (n, 6)."""
    off = []
    for s in found:
        acc = _hand(model, s, 0, s.now.gravity_torque, s.wrench)
        felt = task_inertia(s.now.J_site, s.now.M) @ acc
        off.append((felt - s.wrench) / np.linalg.norm(s.wrench))
    return np.array(off)


def drift(model: mujoco.MjModel, found: Sequence[State], site_bias: Function) -> Array:
    """Return site_bias minus the rate of MuJoCo's J times qd, (n, 6)."""
    return np.array([
        site_bias(s.now.J_space, s.qd, s.now.T_world_ee[:3, 3])
        - contact.mujoco_site_bias(model, s.now.q, s.qd)
        for s in found
    ])  # fmt: skip


def asked_for(
    model: mujoco.MjModel,
    found: Sequence[State],
    task_inertia: Function,
    site_bias: Function,
    osc_torque: Function,
) -> Array:
    """Return the acceleration of MuJoCo's hand minus the one asked for, (n, 6)."""
    off = []
    damping = panda.arm(model).damping
    for s in found:
        J = s.now.J_site
        p = s.now.T_world_ee[:3, 3]
        given = task_inertia(J, s.now.M), s.now.bias(s.qd)
        tau = osc_torque(J, *given, site_bias(s.now.J_space, s.qd, p), s.acc)
        acc = _hand(model, s, s.qd, tau + damping * s.qd, np.zeros(6))
        off.append(acc - s.acc)
    return np.array(off)


def unfelt(
    model: mujoco.MjModel,
    found: Sequence[State],
    task_inertia: Function,
    project: Function,
) -> Array:
    """Return how MuJoCo's resting hand accelerates under projected torques, (n, 6)."""
    off = []
    for s in found:
        J, M = s.now.J_site, s.now.M
        tau = project(J, M, task_inertia(J, M), s.torque)
        off.append(_hand(model, s, 0, s.now.gravity_torque + tau, np.zeros(6)))
    return np.array(off)


def held(
    model: mujoco.MjModel, found: Sequence[State], impedance_torque: Function
) -> Array:
    """Return how the joints accelerate when the hand is pushed back as it pushes."""
    off = []
    damping = panda.arm(model).damping
    for s in found:
        given = s.now.bias(s.qd), damping, s.qd
        tau = impedance_torque(s.now.J_site, s.wrench, *given, s.torque) - s.torque
        off.append(contact.mujoco_push(model, s.now.q, s.qd, tau, -s.wrench)[0])
    return np.array(off)


def rest_after(
    model: mujoco.MjModel, law: simulate.Controller, wrench: Array, rate: float
) -> Array:
    """Return where a push of three seconds takes the hand from ready, (6,)."""
    push = simulate.push_at(contact.SITE, wrench)
    start = simulate.start(model, READY_Q)
    run = simulate.run(model, start, law, 3.0, rate=rate, push=push)
    T, T_end = (panda.arm(model).at(q).T_world_ee for q in (READY_Q, run.q[-1]))
    return jacobian.pose_error(T, T_end)


def off_circle(
    model: mujoco.MjModel, law: simulate.Controller, radius: float, turn: float
) -> Array:
    """Return how far a hand is from `contact.circle` all along one turn, metres."""
    run = simulate.run(model, simulate.start(model, READY_Q), law, turn + 0.5)
    arm = panda.arm(model)
    T = [arm.at(q).T_world_ee for q in run.q]
    goal = [contact.circle(t, T[0], radius, turn)[0] for t in run.t]
    return np.linalg.norm(np.subtract(goal, T)[:, :3, 3], axis=1)


def kinematic(J: Array, M: Array, Lambda: Array, tau: Array) -> Array:
    """Return tau through Day 3's projector, which is for speeds: tau - J^+ J tau."""
    return jacobian.null_step(J, tau)


def compare(check: Check, found: Sequence[State], **own: Function) -> None:
    """Check functions against those of `robo47.task_space` of the same names."""
    rng = np.random.default_rng(len(found))
    n = len(found)
    J, M = np.array([s.now.J_site for s in found]), np.array([s.now.M for s in found])
    torque, V_err, e = (np.array([s[i] for s in found]) for i in (2, 3, 5))
    Lambda = task_space.task_inertia(J, M)
    K, D = rng.normal(size=(2, n, 6, 6))
    force, k, height = rng.uniform([-10, 290, -10], [10, 310, 10], (n, 3)).T
    columns = {
        "null_torque": (J, M, Lambda, torque),
        "spring_wrench": (e, V_err, K + np.swapaxes(K, 1, 2), D),
        "critical_damping": (rng.uniform(30, 400, (n, 6)), Lambda),
        "set_point_for_force": (force, k, height),
        "hybrid_wrench": (e, V_err, K + np.swapaxes(K, 1, 2), D, force),
    }
    for name, function in own.items():
        truth = getattr(task_space, name)(*columns[name])
        check(f"{name} - the library's", each(function, *columns[name]) - truth)


def _hand(model, s: State, qd, tau: Array, wrench: Array) -> Array:
    return contact.mujoco_push(model, s.now.q, qd, tau, wrench)[1]

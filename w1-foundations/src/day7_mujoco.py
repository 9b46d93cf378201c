"""Random moves that a lab's functions of time are asked, and moves that MuJoCo follows.

Radians, metres, seconds, kilograms.
"""

from dataclasses import replace
from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import control, panda, se3, simulate, trajectory
from robo47.checks import Array
from robo47.verify.answers import Check, Function, each
from robo47.verify.oracle import mujoco_bias, random_q

REST = 0.1  # s, before and after a move, to see how it starts and stops


class Moves(NamedTuple):
    """Random moves of the seven joints, long and short."""

    q0: Array  # from where, (n, 7)
    q1: Array  # to where, (n, 7)
    T: Array  # how long each takes, (n,)
    t: Array  # an instant of each, also before its start and after its end, (n,)


def moves(model: mujoco.MjModel, n: int, seed: int) -> Moves:
    """Return n random moves within the joint limits."""
    rng = np.random.default_rng(seed)
    q0, q1 = (random_q(model, n, seed + i)[:, :7] for i in (0, 1))
    q1 = q0 + (q1 - q0) * rng.uniform(0.01, 1.0, (n, 1))
    T = rng.uniform(0.2, 5.0, n)
    return Moves(q0, q1, T, rng.uniform(-0.2, 1.2, n) * T)


def compare(check: Check, at: Moves, seed: int, **own: Function) -> None:
    """Check functions against those of `robo47.trajectory` of the same names."""
    rng = np.random.default_rng(seed)
    n = len(at.T)
    L, v, a = _ramps(n, seed)
    R = se3.quat_to_R(rng.normal(size=(2, n, 4)))
    T0, T1 = se3.make_T(R, rng.uniform(-1, 1, (2, n, 3)))
    turned = se3.Rz(rng.uniform(-np.pi, np.pi, n))
    cubes = se3.make_T(turned, rng.uniform(-1, 1, (n, 3)))
    columns = {
        "quintic_scaling": (at.t, at.T),
        "joint_move": (at.q0, at.q1, at.t, at.T),
        "trapezoid": (rng.uniform(-0.1, 1.1, len(L)) * (L / v + v / a), L, v, a),
        "straight_pose": (T0, T1, rng.uniform(0, 1, n)),
        "grasp_pose": (cubes, rng.uniform(0, 0.3, n)),
        "heaviest_cube": tuple(rng.uniform([0, 0, -5], [10, 2, 5], (n, 3)).T),
    }
    for name, function in own.items():
        truth = getattr(trajectory, name)(*columns[name])
        check(f"{name}, off the library", each(function, *columns[name]) - truth)


def _ramps(n: int, seed: int) -> Array:
    """Return L, v and a of 4 n trapezoids: a sixth are too short to reach v."""
    rng = np.random.default_rng(seed)
    return rng.uniform([0.01, 0.1, 0.5], [3.0, 2.0, 10.0], (4 * n, 3)).T


def too_short(n: int, seed: int) -> float:
    """Return the share of the trapezoids of `compare` that are triangles."""
    L, v, a = _ramps(n, seed)
    return float(np.mean(v**2 / a > L))


def peaks_over_limits(
    at: Moves, quintic_duration: Function, joint_move: Function
) -> Array:
    """Return the largest share of any limit that each joint move uses, (n,)."""
    limits = simulate.SPEED_LIMITS, simulate.ACC_LIMITS
    inner = [0.5 - np.sqrt(3) / 6, 0.5, 0.5 + np.sqrt(3) / 6]  # where both are largest

    def share(q0: Array, q1: Array) -> float:
        T = quintic_duration(q1 - q0, *limits)
        way = [joint_move(q0, q1, x * T, T) for x in (*inner, *np.linspace(0, 1, 20))]
        return float((np.abs(way).max(axis=0)[1:] / limits).max())

    return each(share, at.q0, at.q1)


def missed_ends(quintic_coefficients: Function, at: Moves, seed: int) -> Array:
    """Return how far polynomials miss what they had to be at 0 and at T, (n, 6)."""
    wanted = np.random.default_rng(seed).uniform(-1, 1, (2, len(at.T), 3))

    def ends(start: Array, end: Array, T: float) -> list[float]:
        p = np.polynomial.Polynomial(quintic_coefficients(start, end, T))
        return [f(t) for t in (0.0, T) for f in (p, p.deriv(), p.deriv(2))]

    return each(ends, *wanted, at.T) - np.concatenate(wanted, axis=1)


def carried(model: mujoco.MjModel, carry: Function, q: Array, seed: int) -> Array:
    """Return the bias of an arm whose link 7 carries the hand minus MuJoCo's, N m.

    Args:
        model: the Panda with its hand.
        carry: makes one body of two.
        q: configurations, (n, 7).
        seed: of the velocities.
    """
    heavier = panda.inertias(model).carrying(carry, *panda.hand_inertia(model))
    arm = replace(panda.arm(model), **heavier._asdict())
    qd = np.random.default_rng(seed).uniform(-2, 2, q.shape)
    closed, still = np.zeros((len(q), model.nq - 7)), np.zeros((len(q), model.nv - 7))
    truth = mujoco_bias(model, np.hstack([q, closed]), np.hstack([qd, still]))
    return each(lambda x, xd: arm.at(x).bias(xd), q, qd) - truth[:, :7]


def cubic(t: float, T: float) -> Array:
    """Return s, sd and sdd of the softest scaling with four coefficients, (3,)."""
    x = t / T
    return np.array([3 * x**2 - 2 * x**3, 6 * x - 6 * x**2, 6 - 12 * x]) / [1, T, T**2]


def follow(
    scaling: Function, seconds: float, q0: Array, q1: Array, omega: float, rate: float
) -> tuple[float, float, float]:
    """Follow one straight line in joint space with Day 5's computed torque.

    Args:
        scaling: (s, sd, sdd) at a time.
        seconds: that it takes.
        q0, q1: ends of the line, (7,).
        omega: of the controller, rad/s.
        rate: of the controller, Hz.

    Returns:
        Worst error in mrad, largest jerk in rad/s3, largest share of a torque limit.
    """
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    gains = control.gains(omega, 1.0)
    errors = []

    def controller(t: float, q: Array, qd: Array) -> Array:
        moving = REST <= t < REST + seconds
        s, sd, sdd = scaling(t - REST) if moving else (float(t > REST), 0.0, 0.0)
        errors.append(q0 + (q1 - q0) * s - q)
        now = arm.at(q)
        ed = (q1 - q0) * sd - qd
        acc = (q1 - q0) * sdd
        known = now.M, now.bias(qd), arm.damping, qd
        return control.computed_torque(*known, errors[-1], ed, acc, *gains)

    whole = np.ceil(seconds * rate) / rate + 2 * REST
    run = simulate.run(model, simulate.start(model, q0), controller, whole, rate=rate)
    jerk = np.diff(run.qd, 2, axis=0) * rate**2
    used = np.abs(run.tau) / simulate.limits(model)[1]
    return 1000 * np.abs(errors).max(), np.abs(jerk).max(), used.max()

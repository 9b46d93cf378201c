"""What Day 7 asks of MuJoCo: random moves within its joint limits, and a move followed.

Radians, metres, seconds, kilograms.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import control, panda, se3, simulate
from robo47.checks import Array
from robo47.verify import random_q
from robo47.verify.answers import Function

REST = 0.1  # s, before and after a move, to see how it starts and stops


class Moves(NamedTuple):
    """Random moves of the seven joints, long and short."""

    q0: Array  # from where, (n, 7)
    q1: Array  # to where, (n, 7)
    T: Array  # how long each takes, (n,)
    t: Array  # an instant of each, also before its start and after its end, (n,)


class Followed(NamedTuple):
    """How one move was followed."""

    mrad: float  # the largest error of any joint
    jerk: float  # the largest, rad/s3
    torque: float  # the largest share of a motor's limit


def moves(model: mujoco.MjModel, n: int, seed: int) -> Moves:
    """Return n random moves within the joint limits."""
    rng = np.random.default_rng(seed)
    q0, q1 = (random_q(model, n, seed + i)[:, :7] for i in (0, 1))
    q1 = q0 + (q1 - q0) * rng.uniform(0.01, 1.0, (n, 1))
    T = rng.uniform(0.2, 5.0, n)
    return Moves(q0, q1, T, rng.uniform(-0.2, 1.2, n) * T)


def ramps(n: int, seed: int) -> Array:
    """Return L, v and a of n trapezoids, (3, n): some are too short to reach v."""
    rng = np.random.default_rng(seed)
    return rng.uniform([0.01, 0.1, 0.5], [3.0, 2.0, 10.0], (n, 3)).T


def arguments(at: Moves, seed: int) -> dict[str, tuple[Array, ...]]:
    """Return what to ask the functions that MuJoCo has no call for, (n, ...) each."""
    rng = np.random.default_rng(seed)
    n = len(at.T)
    L, v, a = ramps(4 * n, seed)
    R = se3.quat_to_R(rng.normal(size=(2, n, 4)))
    T0, T1 = se3.make_T(R, rng.uniform(-1, 1, (2, n, 3)))
    turned = se3.Rz(rng.uniform(-np.pi, np.pi, n))
    cubes = se3.make_T(turned, rng.uniform(-1, 1, (n, 3)))
    return {
        "quintic_scaling": (at.t, at.T),
        "joint_trajectory": (at.q0, at.q1, at.t, at.T),
        "trapezoidal_profile": (
            rng.uniform(-0.1, 1.1, len(L)) * (L / v + v / a),
            L,
            v,
            a,
        ),
        "interpolate_pose": (T0, T1, rng.uniform(0, 1, n)),
        "grasp_pose": (cubes, rng.uniform(0, 0.3, n)),
        "max_cube_mass": tuple(rng.uniform([0, 0, -5], [10, 2, 5], (n, 3)).T),
    }


def follow(
    scaling: Function, seconds: float, q0: Array, q1: Array, omega: float, rate: float
) -> Followed:
    """Follow one straight line in joint space with Day 5's computed torque.

    Args:
        scaling: (s, sd, sdd) at a time.
        seconds: that it takes.
        q0, q1: ends of the line, (7,).
        omega: of the controller, rad/s.
        rate: of the controller, Hz.
    """
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    gains = control.pd_gains(omega, 1.0)
    errors = []

    def controller(t: float, q: Array, qd: Array) -> Array:
        moving = REST <= t < REST + seconds
        s, sd, sdd = scaling(t - REST) if moving else (float(t > REST), 0.0, 0.0)
        e = q0 + (q1 - q0) * s - q
        ed = (q1 - q0) * sd - qd
        errors.append(e)
        now = arm.at(q)
        known = now.M, now.bias(qd), arm.damping, qd
        return control.computed_torque(*known, e, ed, (q1 - q0) * sdd, *gains)

    whole = np.ceil(seconds * rate) / rate + 2 * REST
    # Every period asks the controller, writes data.ctrl and calls mujoco.mj_step.
    run = simulate.run(model, simulate.start(model, q0), controller, whole, rate=rate)
    jerk = np.diff(run.qd, 2, axis=0) * rate**2
    used = np.abs(run.tau) / simulate.limits(model)[1]
    return Followed(1000 * np.abs(errors).max(), np.abs(jerk).max(), used.max())

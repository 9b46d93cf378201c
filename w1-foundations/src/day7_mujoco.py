"""Day 7's use of MuJoCo: random motions within joint limits, and a tracked motion.

Radians, metres, seconds, kilograms.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import control, panda, se3, simulate
from robo47.checks import Array
from robo47.verify import random_q
from robo47.verify.answers import Function

REST = 0.1  # s at rest, before and after a motion


class Moves(NamedTuple):
    """Random motions of the seven joints, long and short ones."""

    q0: Array  # the first configurations, rad, (n, 7)
    q1: Array  # the last configurations, rad, (n, 7)
    T: Array  # the durations, s, (n,)
    t: Array  # a time of each, also before its start and after its end, s, (n,)


class Followed(NamedTuple):
    """How accurately the arm tracked one motion."""

    mrad: float  # the largest joint error, mrad
    jerk: float  # the largest jerk, rad/s^3
    torque: float  # the largest torque, as a fraction of the motor's limit


def moves(model: mujoco.MjModel, n: int, seed: int) -> Moves:
    """Return n random motions within the joint limits.

    Args:
        model: a Panda, whose joint ranges are used.
        n: the number of motions.
        seed: of the random numbers.
    """
    rng = np.random.default_rng(seed)
    q0, q1 = (random_q(model, n, seed + i)[:, :7] for i in (0, 1))
    q1 = q0 + (q1 - q0) * rng.uniform(0.01, 1.0, (n, 1))
    T = rng.uniform(0.2, 5.0, n)
    return Moves(q0, q1, T, rng.uniform(-0.2, 1.2, n) * T)


def ramps(n: int, seed: int) -> Array:
    """Return L, v and a of n trapezoidal profiles, (3, n); some never reach v.

    Args:
        n: the number of profiles.
        seed: of the random numbers.
    """
    rng = np.random.default_rng(seed)
    return rng.uniform([0.01, 0.1, 0.5], [3.0, 2.0, 10.0], (n, 3)).T


def arguments(at: Moves, seed: int) -> dict[str, tuple[Array, ...]]:
    """Return the test arguments of the functions that MuJoCo cannot check.

    Args:
        at: the motions of `moves`.
        seed: of the random numbers.

    Returns:
        {function: its arguments}, each argument (n, ...) or (4 n,).
    """
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
    """Return how accurately Day 5's computed torque tracks a line in joint space.

    Args:
        scaling: the time scaling, from a time in s to (s, sd, sdd).
        seconds: the duration of the motion, s.
        q0, q1: the ends of the line, rad, (7,).
        omega: natural frequency of the controller, rad/s.
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
    # Each period calls the controller, writes data.ctrl and calls mujoco.mj_step.
    run = simulate.run(model, simulate.start(model, q0), controller, whole, rate=rate)
    jerk = np.diff(run.qd, 2, axis=0) * rate**2
    used = np.abs(run.tau) / simulate.limits(model)[1]
    return Followed(1000 * np.abs(errors).max(), np.abs(jerk).max(), used.max())

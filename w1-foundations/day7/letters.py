"""The demo of Day 7: the hand writes 47 in the air, stroke by stroke.

Each stroke is a `interpolate_pose` under a `quintic_scaling`, followed with Day 6's
operational-space torque; the elbow is held where it began. Metres, seconds.
"""

import itertools
from typing import Any, NamedTuple

import numpy as np

from robo47 import control, jacobian, panda, simulate, task_space
from robo47.arm import Arm, ArmState
from robo47.checks import Array

OMEGA = 30.0  # rad/s, of the hand's error; 100 shakes at this rate
POSTURE = (40.0, 8.0)  # N m/rad, N m s/rad: how firmly the elbow stays
SPEED = 0.3  # m/s, the hand's top speed in every stroke
RATE = 250.0  # Hz
BOARD, LIFTED = 0.50, 0.47  # m, x of the board, and of the pen between letters
# The corners (x, y, z); seen from the robot, y counts to the left.
CORNERS = np.array([
    [BOARD, 0.12, 0.64],  # 4: down to the left, to the right, and the post
    [BOARD, 0.20, 0.50],
    [BOARD, 0.05, 0.50],
    [LIFTED, 0.09, 0.57],
    [BOARD, 0.09, 0.57],
    [BOARD, 0.09, 0.42],
    [LIFTED, -0.04, 0.64],
    [BOARD, -0.04, 0.64],  # 7: to the right, and down
    [BOARD, -0.18, 0.64],
    [BOARD, -0.10, 0.42],
])  # fmt: skip


class Written(NamedTuple):
    """The planned and the actual path of the pen, (N, 3), and its costs.

    Attributes:
        wanted: metres.
        reached: metres.
        seconds: all strokes together.
        torque: largest fraction of a torque limit.
        q: where the arm ends, (7,).
    """

    wanted: Array
    reached: Array
    seconds: float
    torque: float
    q: Array


def write(fns: Any) -> Written:
    """Simulate it, from the first corner on.

    Args:
        fns: has `quintic_scaling` and `interpolate_pose`: the lab, or the library.
    """
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    poses = np.tile(arm.at(panda.READY_Q).T_world_ee, (len(CORNERS), 1, 1))
    poses[:, :3, 3] = CORNERS
    limits, tau_max = simulate.limits(model)
    q_start = jacobian.solve_ik(arm.screws, arm.M_home, poses[0], panda.READY_Q, limits)
    data = simulate.start(model, q_start)
    wanted = []
    reached = []
    torque = 0.0
    seconds = 0.0
    for T0, T1 in itertools.pairwise(poses):
        way = jacobian.pose_error(T0, T1)
        T = np.ceil(15 / 8 * np.linalg.norm(way[3:]) / SPEED * RATE) / RATE

        def controller(t: float, q: Array, qd: Array) -> Array:
            s, sd, sdd = fns.quintic_scaling(t, T)  # noqa: B023 (called in this round)
            now = arm.at(q)
            T_ref = fns.interpolate_pose(T0, T1, s)  # noqa: B023
            wanted.append(T_ref[:3, 3])
            reached.append(now.T_world_ee[:3, 3])
            ed = sd * way - now.J_site @ qd  # noqa: B023
            kp, kd = control.pd_gains(OMEGA, 1.0)
            e = jacobian.pose_error(now.T_world_ee, T_ref)
            return torques(arm, now, q_start - q, qd, sdd * way + kd * ed + kp * e)  # noqa: B023

        run = simulate.run(model, data, controller, T, rate=RATE)
        torque = max(torque, float((np.abs(run.tau) / tau_max).max()))
        seconds += T
    return Written(np.array(wanted), np.array(reached), seconds, torque, run.q[-1])


def torques(arm: Arm, now: ArmState, away: Array, qd: Array, acc: Array) -> Array:
    """Return the torques, (7,), that accelerate the hand by acc, (6,)."""
    J, M = now.J_site, now.M
    Lambda = task_space.task_inertia(J, M)
    hand = task_space.osc_torque(
        J, Lambda, now.bias(qd), now.bias_acceleration(qd), acc
    )
    back = control.pd_torque(away, -qd, *POSTURE)
    return hand + arm.damping * qd + task_space.nullspace_torque(J, M, Lambda, back)

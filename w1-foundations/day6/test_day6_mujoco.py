"""Pushes, presses and circles for a hand, against MuJoCo and against each other."""

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from robo47 import jacobian, panda, scenes, se3, simulate, verify
from robo47.rotation_log import small_pose_error

lab = load_script(ROOT / "w1-foundations/src/day6_task_space.py")
day6_mujoco = lab.day6_mujoco


@pytest.fixture(scope="module")
def motors():
    model = panda.load("panda_nohand", drive="torque")
    return model, panda.arm(model)


def test_the_circle_starts_at_rest_and_its_parts_are_each_others_rates():
    T0, h = np.eye(4), 1e-4
    T, V, _ = day6_mujoco.circle(0.0, T0, 0.12, 2.0)
    assert_same(T, T0)
    assert_same(V, np.zeros(6))
    for t in (0.3, 0.8, 1.4, 2.3):
        around = [day6_mujoco.circle(t + k * h, T0, 0.12, 2.0) for k in (-1, 0, 1)]
        p = [T[:3, 3] for T, _, _ in around]
        V = [V for _, V, _ in around]
        assert_same((p[2] - p[0]) / (2 * h), V[1][3:], 1e-7)
        assert_same((V[2] - V[0]) / (2 * h), around[1][2], 1e-6)
        assert np.hypot(p[1][1], p[1][2] - 0.12) == pytest.approx(0.12)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-3, 0.3, 1.5])
def test_the_error_of_a_loop_is_that_of_the_jacobians_module(angle):
    rng = np.random.default_rng(8)
    for axis, p in zip(*rng.normal(size=(2, 20, 3)), strict=True):
        T = se3.make_T(se3.quat_to_R(rng.normal(size=4)), p)
        R = se3.axis_angle(axis / np.linalg.norm(axis), angle)
        T_goal = se3.make_T(R @ T[:3, :3], rng.normal(size=3))
        truth = jacobian.pose_error(T, T_goal)
        assert_same(small_pose_error(T, T_goal), truth, 1e-13)


def test_the_site_bias_from_differences_is_the_arms_own(motors):
    model, arm = motors
    rng = np.random.default_rng(6)
    for q in verify.random_q(model, 50, seed=6):
        qd = rng.uniform(-1, 1, 7)
        assert_same(
            verify.mujoco_bias_acceleration(model, q, qd),
            arm.at(q).bias_acceleration(qd),
            1e-10,
        )
        assert_same(verify.mujoco_bias_acceleration(model, q, 0.0), np.zeros(6), 0.0)


def test_a_pushed_arm_accelerates_by_the_equation_of_motion(motors):
    model, arm = motors
    rng = np.random.default_rng(7)
    for q in verify.random_q(model, 50, seed=7):
        qd, tau = rng.uniform(-1, 1, (2, 7))
        F = rng.uniform(-10, 10, 6)
        now = arm.at(q)
        J = now.J_site
        given = tau - now.bias(qd) - arm.damping * qd
        truth = np.linalg.solve(now.M, given + J.T @ F)
        data = lab.pushed(model, q, qd, tau, F)
        assert_same(data.qacc, truth, 1e-9)
        hand = lab.hand_acceleration(model, data)
        assert_same(hand, J @ truth + now.bias_acceleration(qd), 1e-8)


@pytest.mark.parametrize("gap", [0.01, 0.001, -0.05])
def test_the_tip_stands_over_the_table_at_the_wanted_height(gap):
    model = scenes.press_table()
    q = day6_mujoco.above_table(model, gap)
    data = simulate.start(model, q)
    tip = data.site(day6_mujoco.SITE)
    assert_same(tip.xpos, [*scenes.PRESS_XY, scenes.TOUCH + gap], 1e-7)
    assert_same(tip.xmat.reshape(3, 3)[2], [0, 0, -1], 1e-3)
    mujoco.mj_forward(model, data)
    assert (data.ncon > 0) == (gap < 0)


def test_a_held_arm_above_the_table_feels_nothing_and_a_falling_one_does():
    hold = lambda arm, q: lambda t, x, qd: arm.at(x).gravity_torque  # noqa: E731
    assert_same(day6_mujoco.press(hold, seconds=0.2, rate=100.0), np.zeros(100))
    fall = lambda arm, q: lambda t, x, qd: np.zeros(7)  # noqa: E731
    assert day6_mujoco.press(fall, seconds=0.5, rate=100.0).max() > 10.0

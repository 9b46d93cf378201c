"""Trajectories against SciPy, Modern Robotics, Ruckig and MuJoCo."""

import importlib.util

import hypothesis.extra.numpy as hnp
import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation, Slerp

from conftest import need
from robo47 import lifting, panda, se3, trajectory
from robo47.simulate import ACC_LIMITS, SPEED_LIMITS

durations = st.floats(0.05, 20.0)
times = st.floats(-1.0, 25.0)
joints = hnp.arrays(np.float64, 7, elements=st.floats(-3, 3))
metres = hnp.arrays(np.float64, 3, elements=st.floats(-2, 2))
vectors = hnp.arrays(np.float64, 3, elements=st.floats(-3, 3))

# The move of the tutorial, from the ready pose.
MOVE = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6]) - panda.READY_Q


@st.composite
def poses(draw):
    R = Rotation.from_rotvec(draw(vectors)).as_matrix()
    return se3.make_T(R, draw(metres))


def test_the_tutorial_cases_of_day_7():
    assert_same(trajectory.quintic_scaling(0.6, 2), [0.16308, 0.6615, 1.26], 1e-12)
    assert_same(trajectory.quintic_scaling(1.0, 2.0), [0.5, 0.9375, 0.0], 1e-15)
    assert trajectory.quintic_duration([1.0], 1.875, np.inf) == 1.0
    half = trajectory.joint_trajectory(np.zeros(7), np.ones(7), 1.0, 2.0)
    assert_same(half, np.repeat([[0.5], [0.9375], [0.0]], 7, axis=1), 1e-15)
    assert_same(
        trajectory.trapezoidal_profile(1.0, 1.0, 0.5, 1.0), [0.375, 0.5, 0.0], 1e-15
    )
    assert_same(
        trajectory.trapezoidal_profile(2.5, 1.0, 0.5, 1.0), [1.0, 0.0, 0.0], 1e-15
    )
    peak = trajectory.trapezoidal_profile(0.4472 / 2, 0.1, 1.0, 2.0)
    assert_same(peak[:2], [0.05, 0.4472], 1e-4)
    six = trajectory.quintic_coefficients([0, 0, 0], [1, 0, 0], 1.0)
    assert_same(six, [0, 0, 0, 10, -15, 6], 1e-12)
    cube = se3.make_T(se3.Rz(np.radians(80)), [0.5, 0.1, 0.2])
    turned = se3.Rz(np.radians(-10)) @ np.diag([1, -1, -1])
    assert_same(
        lifting.grasp_pose(cube, 0.1), se3.make_T(turned, [0.5, 0.1, 0.3]), 1e-15
    )
    none = np.zeros((3, 3))
    both = lifting.combine_bodies(1, [0, 0, 0], none, 1, [2, 0, 0], none)
    assert_same(both, [2, 1, 0, 0, 0, 2, 2, 0, 0, 0])
    assert lifting.max_cube_mass(0.9173, 1, 0) == pytest.approx(0.187, abs=1e-4)


@given(durations)
def test_the_quintic_is_scipys_polynomial_with_its_derivatives(T):
    t = np.linspace(0, T, 50)
    truth = BPoly.from_derivatives([0, T], [[0, 0, 0], [1, 0, 0]])
    ours = trajectory.quintic_scaling(t, T)
    for k in range(3):
        assert_same(ours[:, k], truth(t, nu=k), 1e-12 * max(1.0, T**-k) * 10)


@given(times, durations)
def test_the_quintic_stands_still_outside_and_never_exceeds_its_peaks(t, T):
    s, sd, sdd = trajectory.quintic_scaling(t, T)
    assert 0.0 <= s <= 1.0
    assert 0.0 <= sd <= 1.875 / T * (1 + 1e-12)
    assert abs(sdd) <= 10 / np.sqrt(3) / T**2 * (1 + 1e-12)
    if t <= 0 or t >= T:
        assert [s, sd, sdd] == [float(t >= T), 0.0, 0.0]


def test_a_joint_move_is_the_textbooks_trajectory():
    # The example in the docstring of modern_robotics.JointTrajectory, with a quintic.
    start = [1, 0, 0, 1, 1, 0.2, 0, 1]
    end = [1.2, 0.5, 0.6, 1.1, 2, 2, 0.9, 1]
    ours = trajectory.joint_trajectory(start, end, np.linspace(0, 4, 6), 4.0)
    assert_same(ours[0, 0], start)
    # modern_robotics 1.1.1 prints these rows for Tf = 4, N = 6, method = 5.
    second = [1.011584, 0.02896, 0.034752, 1.005792, 1.05792, 0.304256, 0.052128, 1.0]
    third = [1.063488, 0.15872, 0.190464, 1.031744, 1.31744, 0.771392, 0.285696, 1.0]
    assert_same(ours[1, 0], second, 1e-12)
    assert_same(ours[2, 0], third, 1e-12)
    assert_same(ours[5, 0], end)


@given(joints.filter(lambda dq: np.abs(dq).max() > 1e-3))
def test_the_duration_uses_a_limit_up_and_breaks_none(dq):
    T = trajectory.quintic_duration(dq, SPEED_LIMITS, ACC_LIMITS)
    t = np.linspace(0, T, 2001)
    _, qd, qdd = np.moveaxis(trajectory.joint_trajectory(np.zeros(7), dq, t, T), 1, 0)
    used = max((np.abs(qd) / SPEED_LIMITS).max(), (np.abs(qdd) / ACC_LIMITS).max())
    assert used == pytest.approx(1.0, abs=1e-5)


def test_the_duration_of_the_tutorials_move_is_joint_7s_speed_rule():
    T = trajectory.quintic_duration(MOVE, SPEED_LIMITS, ACC_LIMITS)
    assert pytest.approx(0.99497, abs=5e-6) == T
    assert pytest.approx(1.875 * abs(MOVE[6]) / SPEED_LIMITS[6], abs=1e-12) == T


@given(times, st.floats(0, 10), st.floats(0.1, 5), st.floats(0.1, 20))
def test_a_trapezoid_keeps_its_limits_and_arrives(t, L, v, a):
    s, sd, sdd = trajectory.trapezoidal_profile(t, L, v, a)
    assert -1e-12 <= s <= L * (1 + 1e-12)
    assert 0.0 <= sd <= v * (1 + 1e-12)
    assert abs(sdd) <= a
    assert_same(trajectory.trapezoidal_profile(1e6, L, v, a), [L, 0.0, 0.0])


@given(st.floats(0.01, 10), st.floats(0.1, 5), st.floats(0.1, 20))
def test_a_trapezoids_speed_is_the_integral_of_its_acceleration(L, v, a):
    top = min(v, np.sqrt(L * a))
    T = L / top + top / a
    t = np.linspace(0, T, 4001)
    s, sd, sdd = np.moveaxis(trajectory.trapezoidal_profile(t, L, v, a), -1, 0)
    h = t[1]
    assert_same(np.cumsum(sdd[:-1]) * h, sd[1:], 3 * a * h)
    assert_same(np.cumsum((sd[1:] + sd[:-1]) / 2) * h, s[1:], 3 * top * h)


@given(vectors, vectors, durations)
def test_the_coefficients_are_scipys_polynomial(start, end, T):
    ours = trajectory.quintic_coefficients(start, end, T)
    truth = BPoly.from_derivatives([0, T], [start, end])
    t = np.linspace(0, T, 20)
    powers = t[:, None] ** np.arange(6)
    scale = 1.0 + T**2
    assert_same(powers @ ours, truth(t), 1e-10 * scale)


@given(poses(), poses(), st.floats(0, 1))
def test_a_straight_pose_is_scipys_slerp_on_a_straight_line(T0, T1, s):
    turn = Rotation.from_matrix(T0[:3, :3].T @ T1[:3, :3]).magnitude()
    if turn > np.pi - 1e-6:
        return  # half a turn has two shortest ways
    ours = trajectory.interpolate_pose(T0, T1, s)
    both = Rotation.from_matrix([T0[:3, :3], T1[:3, :3]])
    assert_same(ours[:3, :3], Slerp([0, 1], both)(s).as_matrix(), 1e-8)
    assert_same(ours[:3, 3], (1 - s) * T0[:3, 3] + s * T1[:3, 3], 1e-12)


@given(st.floats(-np.pi, np.pi), metres, st.floats(0, 0.5))
def test_a_grasp_points_down_along_a_side_and_turns_by_45_degrees_at_most(yaw, p, up):
    cube = se3.make_T(se3.Rz(yaw), p)
    T = lifting.grasp_pose(cube, up)
    assert_same(T[:3, 2], [0, 0, -1.0], 1e-15)
    assert_same(T[:3, 3] - p, [0, 0, up], 1e-15)
    along = np.abs(cube[:2, :2].T @ T[:2, 1])  # the fingers' way, in the cube's axes
    assert_same(np.sort(along), [0.0, 1.0], 1e-9)
    assert abs(np.arctan2(T[1, 0], T[0, 0])) <= np.pi / 4 + 1e-9


def test_a_link_that_carries_the_hand_is_mujocos_fused_body():
    model = panda.load("panda")
    links, hand = panda.inertias(model), panda.hand_inertia(model, 0.02)
    last = (part[6] for part in links)
    ours = lifting.combine_bodies(*last, *hand)
    data = mujoco.MjData(model)
    data.qpos[7:9] = 0.02
    mujoco.mj_forward(model, data)
    link7 = model.body("link7").id
    R, p = data.xmat[link7].reshape(3, 3), data.xpos[link7]
    assert ours[0] == pytest.approx(model.body_subtreemass[link7], abs=1e-14)
    assert_same(ours[1:4], R.T @ (data.subtree_com[link7] - p), 1e-12)


@given(st.floats(0.01, 5), metres, st.floats(0.01, 5), metres)
def test_carrying_works_either_way_round_and_keeps_the_moment_about_any_point(
    m1, c1, m2, c2
):
    I1, I2 = np.diag([1.0, 2.0, 2.5]), np.diag([0.3, 0.2, 0.4])
    both = lifting.combine_bodies(m1, c1, I1, m2, c2, I2)
    assert_same(both, lifting.combine_bodies(m2, c2, I2, m1, c1, I1), 1e-9)

    def about_origin(m, c, inertia):
        return inertia + m * (c @ c * np.eye(3) - np.outer(c, c))

    xx, yy, zz, xy, xz, yz = both[4:]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    truth = about_origin(m1, c1, I1) + about_origin(m2, c2, I2)
    assert_same(about_origin(both[0], both[1:4], inertia), truth, 1e-9)


def test_many_at_once_equal_one_at_a_time():
    rng = np.random.default_rng(7)
    t = rng.uniform(0, 2, 5)
    q0, q1 = rng.normal(size=(2, 5, 7))
    ours = trajectory.joint_trajectory(q0, q1, t, 2.0)
    T0 = se3.make_T(se3.Rz(t), rng.normal(size=(5, 3)))
    T1 = se3.make_T(se3.Rx(t), rng.normal(size=(5, 3)))
    straight = trajectory.interpolate_pose(T0, T1, t / 2)
    ends = rng.normal(size=(5, 3))
    six = trajectory.quintic_coefficients(ends, [1, 0, 0], t + 1)
    heavy = lifting.combine_bodies(t, ends, np.eye(3), 1.0, [0, 0, 1], np.eye(3))
    assert heavy.shape == (5, 10)
    for i in range(5):
        assert_same(
            ours[i], trajectory.joint_trajectory(q0[i], q1[i], t[i], 2.0), 1e-14
        )
        one = trajectory.interpolate_pose(T0[i], T1[i], t[i] / 2)
        assert_same(straight[i], one, 1e-14)
        one = trajectory.quintic_coefficients(ends[i], [1, 0, 0], t[i] + 1)
        assert_same(six[i], one, 1e-12)


def ruckig_move(dq, jerk):
    need(
        importlib.util.find_spec("ruckig") is not None,
        "Ruckig: python3 scripts/setup_env.py trajectory",
    )
    import ruckig

    wanted = ruckig.InputParameter(len(dq))
    wanted.target_position = list(dq)
    wanted.max_velocity = list(SPEED_LIMITS[: len(dq)])
    wanted.max_acceleration = list(ACC_LIMITS[: len(dq)])
    wanted.max_jerk = list(jerk)
    move = ruckig.Trajectory(len(dq))
    ruckig.Ruckig(len(dq)).calculate(wanted, move)
    return move


@pytest.mark.parametrize("L", [0.05, 0.3, 2.0])
def test_a_trapezoid_is_ruckigs_trajectory_without_a_jerk_limit(L):
    move = ruckig_move([L], [np.inf])
    for t in np.linspace(0.0, move.duration, 40)[1:-1]:
        (s,), (sd,), _ = move.at_time(t)
        ours = trajectory.trapezoidal_profile(t, L, SPEED_LIMITS[0], ACC_LIMITS[0])
        assert_same(ours[:2], [s, sd], 1e-12)
    end = trajectory.trapezoidal_profile(
        move.duration, L, SPEED_LIMITS[0], ACC_LIMITS[0]
    )
    assert_same(end[0], L, 1e-12)


def test_the_quintic_is_slower_than_ruckig_which_has_the_jerk_limits_to_use():
    jerk = [7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10000.0, 10000.0]
    move = ruckig_move(MOVE, jerk)
    shortest = move.duration
    assert shortest == pytest.approx(0.79085, abs=5e-6)
    shares = np.array(move.at_time(shortest / 3)[0]) / MOVE
    assert np.ptp(shares) > 0.01  # its joints leave the straight line in joint space
    assert shortest < trajectory.quintic_duration(MOVE, SPEED_LIMITS, ACC_LIMITS)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: trajectory.quintic_scaling(1.0, 0.0),
            "duration is 0; it must be above 0",
        ),
        (lambda: trajectory.quintic_duration([1.0], 0.0, 1.0), "v_max is 0"),
        (lambda: trajectory.quintic_duration([1.0], np.nan, 1.0), "v_max holds"),
        (lambda: trajectory.joint_trajectory([0] * 7, [0] * 6, 0, 1), "q1 has shape"),
        (lambda: trajectory.trapezoidal_profile(0, -1, 1, 1), "L is -1"),
        (
            lambda: trajectory.trapezoidal_profile(0, 1, 1, 0),
            "a is 0; it must be above 0",
        ),
        (
            lambda: trajectory.interpolate_pose(np.ones((4, 4)), np.eye(4), 0),
            "T0 is not",
        ),
        (
            lambda: lifting.combine_bodies(
                0, [0] * 3, np.eye(3), 0, [0] * 3, np.eye(3)
            ),
            r"m1 \+ m2 is 0; it must be above 0",
        ),
        (lambda: lifting.max_cube_mass(1, -1, 0), "mu is -1; it must not be below"),
        (lambda: lifting.max_cube_mass(1, 1, -10), r"9.81 \+ acceleration is -0.19"),
    ],
)
def test_what_is_wrong_is_named_in_one_line(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)

"""The oracle: MuJoCo's own poses, and the search for the worst difference."""

import mujoco
import numpy as np
import pytest
from compare import assert_same
from scipy.spatial.transform import Rotation

from robo47 import jacobian, panda, screws, se3, verify
from robo47.errors import Robo47Error

import day3_mujoco


def test_the_poses_are_those_of_mj_forward(twin):
    model = panda.load("panda_nohand")
    q = verify.random_q(model, 5, seed=1)
    poses = verify.mujoco_poses(model, q)
    data = mujoco.MjData(model)
    for i, row in enumerate(q):
        data.qpos[:] = row
        mujoco.mj_forward(model, data)
        assert_same(poses["body:link4"][i, :3, 3], data.body("link4").xpos, 0.0)
        site = data.site("attachment_site")
        T = se3.make_T(site.xmat.reshape(3, 3), site.xpos)
        assert_same(poses["site:attachment_site"][i], T, 0.0)


def test_random_configurations_fill_the_joint_limits_and_repeat(either_panda):
    q = verify.random_q(either_panda, 4000, seed=47)
    low, high = either_panda.jnt_range.T
    assert np.all((q >= low) & (q <= high))
    assert np.all(np.ptp(q, axis=0) > 0.99 * (high - low))
    assert_same(verify.random_q(either_panda, 4000, seed=47), q, 0.0)
    assert np.any(verify.random_q(either_panda, 4000, seed=48) != q)


def test_joints_without_limits_get_a_full_turn_or_a_metre():
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body><joint name="h"/><joint name="s" type="slide"/>
      <geom size="1"/></body></worldbody></mujoco>""")
    span = np.abs(verify.random_q(model, 4000, seed=1)).max(axis=0)
    assert_same(span, [np.pi, 1.0], 0.01)


def test_a_model_with_a_ball_joint_is_refused():
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body><joint type="ball"/><geom size="1"/></body></worldbody>
      </mujoco>""")
    with pytest.raises(ValueError, match="ball or free joint"):
        verify.random_q(model, 1, seed=1)


def test_the_worst_difference_is_found_with_its_frame_and_configuration():
    truth = {"body:a": np.zeros((3, 4, 4)), "body:b": np.zeros((3, 4, 4))}
    ours = {name: T.copy() for name, T in truth.items()}
    ours["body:b"][2, 0, 3] = -0.25
    q = np.array([[10.0], [11.0], [12.0]])
    worst = verify.worst_difference(ours, truth, q)
    assert (worst.error, worst.frame, worst.q) == (0.25, "body:b", [12.0])


def test_nan_is_the_worst_difference_there_is():
    truth = {"body:a": np.zeros((2, 4, 4)), "body:b": np.zeros((2, 4, 4))}
    ours = {name: T + 1.0 for name, T in truth.items()}
    ours["body:a"][1, 0, 0] = np.nan
    worst = verify.worst_difference(ours, truth, np.zeros((2, 1)))
    assert (worst.error, worst.frame) == (np.inf, "body:a")


def test_sets_of_different_frames_are_not_compared():
    with pytest.raises(ValueError, match="body:b"):
        verify.worst_difference({"body:a": np.eye(4)}, {"body:b": np.eye(4)}, np.eye(1))


def pendulum():
    """One hinge about y: 2 kg at 0.5 m along x, armature 0.3, damping 0.7."""
    return mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body>
        <joint name="hinge" axis="0 1 0" armature="0.3" damping="0.7"/>
        <inertial mass="2" pos="0.5 0 0" diaginertia="1e-9 1e-9 1e-9"/>
        <site name="tip" pos="1 0 0"/>
      </body></worldbody><actuator><motor joint="hinge"/></actuator></mujoco>""")


def test_mujocos_answers_for_a_pendulum_are_those_on_paper():
    model, q, qd = pendulum(), [0.4], [1.5]
    inertia, weight = 2.0 * 0.25 + 0.3, -2.0 * 9.81 * 0.5 * np.cos(0.4)
    assert_same(verify.mujoco_mass_matrix(model, q), [[inertia]], 1e-8)
    assert_same(verify.mujoco_bias(model, q, qd), [weight], 1e-12)
    torque = inertia * 4.0 + weight + 0.7 * 1.5
    inverse = verify.mujoco_inverse_dynamics(model, q, qd, [4.0])
    assert_same(inverse, [torque], 1e-7)
    assert_same(verify.mujoco_acceleration(model, q, qd, [torque]), [4.0], 1e-7)
    # Euler's step takes the damping at its end.
    h = model.opt.timestep
    after = 1.5 + h * (torque - weight - 0.7 * 1.5) / (inertia + h * 0.7)
    assert_same(verify.mujoco_step(model, q, qd, [torque]), [after], 1e-9)


def test_mujocos_site_jacobian_comes_as_omega_then_v():
    J = verify.mujoco_site_jacobian(pendulum(), [0.4], "tip")
    s, c = np.sin(0.4), np.cos(0.4)
    assert_same(J[:, 0], [0.0, 1.0, 0.0, -s, 0.0, -c], 1e-15)


def test_many_states_are_asked_in_the_callers_own_shape(either_panda):
    q = verify.random_q(either_panda, 6, seed=3)
    M = verify.mujoco_mass_matrix(either_panda, q.reshape(2, 3, 7))
    assert_same(M[1, 2], verify.mujoco_mass_matrix(either_panda, q[5]), 0.0)
    bias = verify.mujoco_bias(either_panda, q, np.zeros(7))
    assert_same(bias[4], verify.mujoco_bias(either_panda, q[4], np.zeros(7)), 0.0)


def test_one_state_leaves_nothing_behind_for_the_next():
    """Both start anew: time, warm start and forces of the first are forgotten."""
    model = pendulum()
    twice = verify.mujoco_step(model, [[0.4], [0.4]], [1.5], [3.0])
    assert_same(twice[0], twice[1], 0.0)


def test_a_site_that_is_not_there_is_named():
    with pytest.raises(Robo47Error, match="no site 'attachment_site'; load panda_no"):
        verify.mujoco_site_jacobian(pendulum(), [0.0])


def test_each_asks_a_function_once_per_row():
    asked = verify.each(
        lambda R, p: R @ p, np.eye(3)[None] * [[[2.0]], [[3.0]]], np.eye(3)[:2]
    )
    assert asked.tolist() == [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]
    with pytest.raises(ValueError, match="shorter"):
        verify.each(max, np.zeros(2), np.zeros(1))


# --- what judges a lab's functions: the library's pass, and a wrong one does not ---

PANDA = panda.load("panda_nohand")
ARM, LIMITS = (panda.screws(PANDA), panda.home_pose(PANDA)), PANDA.jnt_range


def poses(n, seed):
    q = verify.random_q(PANDA, n, seed)
    return q, screws.fk_space(*ARM, q)


def test_a_solver_is_judged_by_where_it_ends():
    q, T = poses(8, 6)
    good = day3_mujoco.ends_of(jacobian.solve_ik, ARM, LIMITS, q, 7)
    assert good.missed == good.beyond == 0.0
    assert good.out_of_reach.max() == pytest.approx(1.0)
    lazy = day3_mujoco.ends_of(lambda S, M, T, q, limits: q + 9.0, ARM, LIMITS, q, 7)
    assert lazy.missed == 1.0
    assert lazy.beyond > 1.0
    assert lazy.out_of_reach.max() > 1.01
    at = day3_mujoco.tries(jacobian.solve_ik, ARM, LIMITS, T[:3], q[0], 2, 8)
    assert at.tolist() == [1, 1, 1]
    never = day3_mujoco.tries(
        lambda S, M, T, q, limits: q, ARM, LIMITS, T[1:], q[0], 2, 8
    )
    assert never.tolist() == [0, 0, 0]  # after three failures the rest is spared


def test_the_joints_axes_and_rotations_are_mujocos():
    S = verify.mujoco_screws(PANDA, np.zeros((1, 7)))[0]
    assert np.abs(S - ARM[0]).max() < 1e-12
    R = verify.mujoco_rotation(np.array([0.0, 0.6, 0.8]), 0.5)
    assert np.abs(R - screws.exp_rotation([0.0, 0.6, 0.8], 0.5)).max() < 1e-12


def test_what_is_no_number_is_off_and_ends_no_lab():
    _, T = poses(4, 9)
    assert np.isnan(day3_mujoco.moved(T, np.full((4, 6), np.nan))).any()
    off = day3_mujoco.miss(ARM, np.full((2, 7), np.nan), T[:2])
    assert off.tolist() == [np.inf] * 2


def test_the_turns_of_day_3_have_the_logarithms_that_scipy_finds():
    R, logs = day3_mujoco.turns(40, 47)
    found = Rotation.from_matrix(R[13:]).as_rotvec()
    assert np.abs(found - logs[13:]).max() < 1e-7
    assert_same(R[12], np.diag([-1.0, 1.0, -1.0]), 0.0)
    assert_same(np.sort(np.pi - np.linalg.norm(logs[3:12], axis=1)),
                10.0 ** -np.arange(9, 0, -1), 1e-12)  # fmt: skip


def test_a_hand_moved_by_its_error_is_at_its_goal():
    _, T = poses(12, 2)
    e = jacobian.pose_error(T[:6], T[6:])
    assert np.abs(day3_mujoco.moved(T[:6], e) - T[6:]).max() < 1e-9
    assert np.abs(day3_mujoco.moved(T[:6], -e) - T[6:]).max() > 0.1

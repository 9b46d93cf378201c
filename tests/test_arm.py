"""Everything of one configuration at once: against MuJoCo and the plain functions."""

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from robo47 import dynamics, panda, se3, verify
from robo47.arm import Arm

N = 100


@pytest.fixture
def motions(either_panda):
    """A model, its arm, and N motions of it with the arm at each."""
    rng = np.random.default_rng(8)
    q = verify.random_q(either_panda, N, seed=8)
    arm = panda.arm(either_panda)
    return either_panda, q, rng.uniform(-2, 2, q.shape), [arm.at(row) for row in q]


def every(states, read):
    return np.array([read(now) for now in states])


def test_the_poses_are_mujocos(motions):
    model, q, _, states = motions
    poses = verify.mujoco_poses(model, q)
    assert_same(
        every(states, lambda now: now.T_world_ee), poses["site:attachment_site"], 1e-14
    )
    for i in range(7):
        link = every(states, lambda now, i=i: now.T_links[i])
        assert_same(link, poses[f"body:link{i + 1}"], 1e-14)


def test_the_jacobian_is_mujocos(motions):
    model, q, _, states = motions
    J_site = every(states, lambda now: now.J_site)
    assert_same(J_site, verify.mujoco_site_jacobian(model, q), 1e-14)
    assert np.abs(every(states, lambda now: now.J_space) - J_site).max() > 0.5


def test_mass_matrix_gravity_and_bias_are_mujocos(motions):
    model, q, qd, states = motions
    M = every(states, lambda now: now.M)
    assert_same(M, verify.mujoco_mass_matrix(model, q), 1e-13)
    gravity = every(states, lambda now: now.gravity_torque)
    assert_same(gravity, verify.mujoco_bias(model, q, np.zeros(7)), 1e-12)
    bias = np.array([now.bias(row) for now, row in zip(states, qd, strict=True)])
    assert_same(bias, verify.mujoco_bias(model, q, qd), 1e-12)


@pytest.mark.skipif(
    mujoco.__version__.startswith("3.3."),
    reason="its mj_jacDot leaves out that the point moves",
)
def test_the_sites_acceleration_at_steady_joints_is_mj_jac_dots(motions):
    model, _, qd, states = motions
    data = mujoco.MjData(model)
    site = model.site("attachment_site")
    for now, row in zip(states, qd, strict=True):
        data.qpos, data.qvel = now.q, row
        mujoco.mj_forward(model, data)
        v, omega = np.zeros((2, 3, 7))
        point = data.site_xpos[site.id].copy()
        mujoco.mj_jacDot(model, data, v, omega, point, int(site.bodyid[0]))
        truth = np.concatenate([omega @ row, v @ row])
        assert_same(now.bias_acceleration(row), truth, 1e-12)


def test_the_pieces_are_those_of_the_plain_functions(motions):
    model, _, _, states = motions
    g = model.opt.gravity
    masses, coms, inertias = panda.inertias(model)
    for now in states[:10]:
        G = dynamics.link_inertias(now.T_links, masses, coms, inertias)
        assert_same(now.G, G, 1e-13)
        held = dynamics.gravity_torque(now.J_space, masses, now.coms_world, g)
        assert_same(now.gravity_torque, held, 1e-12)


def test_with_its_hand_it_is_the_menageries_panda(either_panda):
    """panda.xml's arm carries hand and fingers; the last link has them all."""
    model = panda.load("panda")
    arm = panda.arm(model)
    assert arm.masses[-1] == pytest.approx(0.735522 + 0.76, abs=1e-12)
    q = verify.random_q(model, 50, seed=9)
    q[:, 7:] = 0.0
    qd = np.zeros_like(q)
    qd[:, :7] = np.random.default_rng(9).uniform(-2, 2, (50, 7))
    M = verify.mujoco_mass_matrix(model, q)[:, :7, :7]
    bias = verify.mujoco_bias(model, q, qd)[:, :7]
    hand = verify.mujoco_poses(model, q)["body:hand"]
    for i, (row, speed) in enumerate(zip(q[:, :7], qd[:, :7], strict=True)):
        now = arm.at(row)
        assert_same(now.M, M[i], 1e-12)
        assert_same(now.bias(speed), bias[i], 1e-11)
        assert_same(now.T_world_ee, hand[i], 1e-14)


def test_a_load_can_be_carried_and_the_empty_arm_is_as_before(either_panda):
    arm = panda.arm(either_panda)
    before = arm.at(panda.READY_Q).gravity_torque
    T = arm.at(panda.READY_Q).T_links[6]
    loaded = arm.carrying(2.0, [0.0, 0.0, 0.2], np.zeros((3, 3)))
    point = T[:3, :3] @ [0.0, 0.0, 0.2] + T[:3, 3]
    T_world_load = se3.make_T(np.eye(3), point)
    now = loaded.tool(se3.inverse(arm.at(panda.READY_Q).T_world_ee) @ T_world_load)
    J_v = now.at(panda.READY_Q).J_site[3:]
    weight = J_v.T @ [0.0, 0.0, -2.0 * 9.81]
    assert_same(loaded.at(panda.READY_Q).gravity_torque, before - weight, 1e-12)
    assert_same(arm.at(panda.READY_Q).gravity_torque, before, 0.0)


def test_the_tool_moves_the_end_and_nothing_else(either_panda):
    arm = panda.arm(either_panda)
    T_ee_tool = se3.make_T(se3.Rx(0.3)[:3, :3], [0.0, 0.01, 0.1034])
    now, plain = arm.tool(T_ee_tool).at(panda.READY_Q), arm.at(panda.READY_Q)
    assert_same(now.T_world_ee, plain.T_world_ee @ T_ee_tool, 1e-15)
    assert_same(now.J_space, plain.J_space, 0.0)
    assert_same(now.M, plain.M, 0.0)
    arrow = now.T_world_ee[:3, 3] - plain.T_world_ee[:3, 3]
    moved = plain.J_site[3:] + np.cross(plain.J_site[:3].T, arrow).T
    assert_same(now.J_site[3:], moved, 1e-14)


@given(arrays(np.float64, 2, elements=st.floats(-3.0, 3.0)))
def test_an_arm_of_a_slide_and_a_hinge_is_what_paper_says(q):
    """A hinge about z, then a slide along its x with a point mass at its origin."""
    arm = Arm(
        screws=[[0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0]],
        M_home=np.eye(4),
        T_zero=np.stack([np.eye(4)] * 2),
        masses=[1.0, 2.0],
        coms=np.zeros((2, 3)),
        inertias=np.stack([np.diag([0.1, 0.2, 0.3]), np.zeros((3, 3))]),
        armature=0.0,
        damping=0.0,
    )
    now = arm.at(q)
    out = q[1]
    assert_same(now.T_world_ee[:2, 3], [out * np.cos(q[0]), out * np.sin(q[0])], 1e-14)
    assert_same(now.M, [[0.3 + 2.0 * out**2, 0.0], [0.0, 2.0]], 1e-13)
    w, v = 0.7, -1.3
    assert_same(now.bias([w, v]), [4.0 * out * w * v, -2.0 * out * w**2], 1e-13)
    assert_same(now.gravity_torque, [0.0, 0.0], 1e-14)


@pytest.mark.parametrize("q", [np.zeros(6), np.zeros((2, 7)), [0.0] * 6 + [np.nan]])
def test_a_wrong_configuration_is_refused(q, twin):
    arm = panda.arm(panda.load())
    with pytest.raises(ValueError, match=r"q (has shape .*; expected|holds)"):
        arm.at(q)


def test_wrong_velocities_and_wrong_arms_are_refused(twin):
    arm = panda.arm(panda.load())
    with pytest.raises(ValueError, match=r"qd has shape \(6,\); expected \(7,\)"):
        arm.at(panda.READY_Q).bias(np.zeros(6))
    with pytest.raises(ValueError, match="masses has shape"):
        Arm(arm.screws, arm.M_home, arm.T_zero, arm.masses[:6], arm.coms,
            arm.inertias, arm.armature, arm.damping)  # fmt: skip
    with pytest.raises(ValueError, match="com has shape"):
        arm.carrying(1.0, [0.0, 0.0], np.zeros((3, 3)))

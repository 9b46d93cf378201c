"""Dynamics against MuJoCo, Pinocchio, the textbook, and worked cases on paper."""

import json
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from conftest import ROOT, load_script
from robo47 import dynamics, panda, screws, verify

G_EARTH = np.array([0.0, 0.0, -9.81])
DATA = Path(__file__).parent / "data"
N = 200

numbers = st.floats(-3.0, 3.0, allow_subnormal=False)
vectors = arrays(np.float64, 3, elements=numbers)
twists = arrays(np.float64, 6, elements=numbers)


def moving(model, n=N, seed=4):
    """Return n random motions and what the formulas take, computed by the library."""
    rng = np.random.default_rng(seed)
    q = verify.random_q(model, n, seed)
    qd, qdd = rng.uniform(-2, 2, q.shape), rng.uniform(-10, 10, q.shape)
    return SimpleNamespace(q=q, qd=qd, qdd=qdd, **vars(terms(model, q)))


def terms(model, q):
    """Return T_links, J, G, the masses and the centres of mass in the world."""
    poses = verify.mujoco_poses(model, q)
    T = np.stack([poses[f"body:link{i}"] for i in range(1, 8)], axis=-3)
    J = np.swapaxes(screws.joint_screws(T), -1, -2)  # each link turns about its z axis
    masses, coms, inertias = panda.inertias(model)
    coms_world = (T[..., :3, :3] @ coms[..., None])[..., 0] + T[..., :3, 3]
    G = dynamics.link_inertias(T, masses, coms, inertias)
    return SimpleNamespace(T=T, J=J, G=G, masses=masses, coms_world=coms_world)


@pytest.fixture
def arm(either_panda):
    """panda_nohand with motors, and N motions of it."""
    model = panda.load("panda_nohand", drive="torque")
    return model, moving(model)


def test_the_mass_matrix_is_mujocos(arm):
    model, now = arm
    M = dynamics.mass_matrix(now.J, now.G, model.dof_armature)
    assert_same(M, verify.mujoco_mass_matrix(model, now.q), 1e-13)


def test_the_gravity_torque_is_mujocos_bias_at_rest(arm):
    model, now = arm
    gravity = dynamics.gravity_torque(now.J, now.masses, now.coms_world, G_EARTH)
    assert_same(gravity, verify.mujoco_bias(model, now.q, np.zeros(7)), 1e-12)


def test_the_bias_torque_is_mujocos(arm):
    model, now = arm
    bias = dynamics.bias_torque(now.J, now.G, now.qd, G_EARTH)
    assert_same(bias, verify.mujoco_bias(model, now.q, now.qd), 1e-12)


def test_inverse_dynamics_with_armature_and_damping_is_mj_inverse(arm):
    model, now = arm
    tau = dynamics.inverse_dynamics(now.J, now.G, now.qd, now.qdd, G_EARTH)
    tau += model.dof_armature * now.qdd + model.dof_damping * now.qd
    truth = verify.mujoco_inverse_dynamics(model, now.q, now.qd, now.qdd)
    assert_same(tau, truth, 1e-12)


def test_forward_dynamics_is_what_the_simulator_computes(arm):
    model, now = arm
    M = dynamics.mass_matrix(now.J, now.G, 0.1)
    bias = dynamics.bias_torque(now.J, now.G, now.qd, G_EARTH)
    tau = np.random.default_rng(5).uniform(*model.actuator_ctrlrange.T, (N, 7))
    qdd = dynamics.forward_dynamics(M, bias, 1.0, now.qd, tau)
    truth = verify.mujoco_acceleration(model, now.q, now.qd, tau)
    assert_same(qdd, truth, 1e-13 * np.abs(truth).max())


def test_one_step_of_the_simulator_can_be_predicted(arm):
    """implicitfast: the damping acts at the end of the step."""
    model, now = arm
    tau = np.random.default_rng(6).uniform(*model.actuator_ctrlrange.T, (N, 7))
    h = model.opt.timestep
    M = dynamics.mass_matrix(now.J, now.G, 0.1) + h * np.diag(model.dof_damping)
    bias = dynamics.bias_torque(now.J, now.G, now.qd, G_EARTH)
    after = now.qd + h * dynamics.forward_dynamics(M, bias, 1.0, now.qd, tau)
    assert_same(after, verify.mujoco_step(model, now.q, now.qd, tau), 1e-13)


def test_the_energies_are_mujocos(arm):
    model, now = arm
    M = dynamics.mass_matrix(now.J, now.G, model.dof_armature)
    both = dynamics.energy(M, now.qd, now.masses, now.coms_world, G_EARTH)
    lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")
    assert_same(both, lab.mujoco_energies(model, now.q, now.qd), 1e-12)


def test_pinocchio_agrees(either_panda):
    """Its answers, kept by make oracle; it takes the armature into M and into tau."""
    answer = json.loads((DATA / "dynamics_oracle.json").read_text())["panda_nohand"]
    q, qd, qdd = (np.array(answer[name]) for name in ("q", "qd", "qdd"))
    now = terms(either_panda, q)
    # MuJoCo 3 reproduces the file's inertias, which Pinocchio reads, to 5e-7.
    tol = 1e-4 if mujoco.__version__.startswith("3.") else 1e-12
    M = dynamics.mass_matrix(now.J, now.G, either_panda.dof_armature)
    assert_same(M, np.array(answer["crba"]), tol)
    bias = dynamics.bias_torque(now.J, now.G, qd, G_EARTH)
    assert_same(bias, np.array(answer["bias"]), tol)
    tau = dynamics.inverse_dynamics(now.J, now.G, qd, qdd, G_EARTH) + 0.1 * qdd
    assert_same(tau, np.array(answer["rnea"]), tol)


def test_a_wrong_mass_matrix_can_be_symmetric_and_positive_definite_too(arm):
    """Why M is judged by its entries: here the corners of G have the wrong sign."""
    model, now = arm
    flip = np.ones((6, 6))
    flip[:3, 3:] = flip[3:, :3] = -1.0
    wrong = dynamics.mass_matrix(now.J, now.G * flip, 0.1)
    assert_same(wrong, np.swapaxes(wrong, -1, -2), 0.0)
    assert np.linalg.eigvalsh(wrong).min() > 0.1
    off = np.abs(wrong - verify.mujoco_mass_matrix(model, now.q)).max(axis=(1, 2))
    assert off.min() > 0.5


# Worked cases that fit on paper.


def pendulum():
    """Return J, G, mass and centre of mass of 1 kg at (1, 0, 0) on a hinge about +y."""
    J = np.array([[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]]).T
    com = np.array([[1.0, 0.0, 0.0]])
    G = dynamics.spatial_inertia([1.0], com, np.zeros((1, 3, 3)))
    return J, G, np.array([1.0]), com


def test_two_links_in_a_plane_as_the_textbook_writes_them():
    """Modern Robotics, section 8.1.1: the 2R arm with point masses, eqs. 8.9 to 8.11.

    The plane is x-z here: gravity pulls along -z, both hinges turn about -y.
    """
    l1, l2, m1, m2, g = 0.7, 0.4, 2.0, 3.0, 9.81
    t1, t2, w1, w2, a1, a2 = 0.3, -1.1, 0.8, -1.7, 2.5, 0.9
    elbow = np.array([l1 * np.cos(t1), 0.0, l1 * np.sin(t1)])
    tip = elbow + np.array([l2 * np.cos(t1 + t2), 0.0, l2 * np.sin(t1 + t2)])
    J = screws.screw_axis([0.0, -1.0, 0.0], np.array([np.zeros(3), elbow])).T
    G = dynamics.spatial_inertia([m1, m2], [elbow, tip], np.zeros((2, 3, 3)))
    c, s = np.cos(t2), np.sin(t2)
    M12 = m2 * (l1 * l2 * c + l2**2)
    M11 = m1 * l1**2 + m2 * (l1**2 + 2 * l1 * l2 * c + l2**2)
    M = np.array([[M11, M12], [M12, m2 * l2**2]])
    coriolis = m2 * l1 * l2 * s * np.array([-(2 * w1 * w2 + w2**2), w1**2])
    far = m2 * l2 * g * np.cos(t1 + t2)
    gravity = np.array([(m1 + m2) * l1 * g * np.cos(t1) + far, far])
    masses, coms = np.array([m1, m2]), np.array([elbow, tip])
    assert_same(dynamics.mass_matrix(J, G, 0.0), M, 1e-14)
    assert_same(dynamics.gravity_torque(J, masses, coms, G_EARTH), gravity, 1e-13)
    tau = dynamics.inverse_dynamics(J, G, [w1, w2], [a1, a2], G_EARTH)
    assert_same(tau, M @ [a1, a2] + coriolis + gravity, 1e-13)


# Algebra.


@given(vectors, twists, st.floats(0.1, 10.0))
def test_a_spatial_inertia_gives_the_kinetic_energy(c, V, m):
    """m v_c^2 / 2 + omega I omega / 2, with v_c the velocity of the centre of mass."""
    I = np.diag([0.2, 0.3, 0.4])  # noqa: E741
    omega, v_c = V[:3], V[3:] + np.cross(V[:3], c)
    energy = 0.5 * m * v_c @ v_c + 0.5 * omega @ I @ omega
    G = dynamics.spatial_inertia(m, c, I)
    assert abs(0.5 * V @ G @ V - energy) <= 1e-12 * max(1.0, np.abs(G).max())


@given(vectors, st.floats(0.1, 10.0))
def test_seen_from_another_place_it_is_the_same_inertia(p, m):
    """G_world = Ad(T^-1)^T G_body Ad(T^-1) (Modern Robotics, section 8.2.2)."""
    I, c = np.diag([0.2, 0.3, 0.4]), np.array([0.1, -0.2, 0.3])  # noqa: E741
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = screws.exp_rotation([0.6, 0.0, 0.8], 0.7), p
    there = dynamics.link_inertias(T[None], [m], c[None], I[None])[0]
    Ad = np.linalg.inv(screws.adjoint(T))
    here = dynamics.spatial_inertia(m, c, I)
    assert_same(there, Ad.T @ here @ Ad, 1e-12 * max(1.0, np.abs(there).max()))


def test_a_batch_is_its_configurations_one_by_one(either_panda):
    now = moving(either_panda, n=6)

    def everything(J, G, qd, qdd, coms):
        M = dynamics.mass_matrix(J, G, 0.1)
        bias = dynamics.bias_torque(J, G, qd, G_EARTH)
        return (
            M,
            bias,
            dynamics.gravity_torque(J, now.masses, coms, G_EARTH),
            dynamics.inverse_dynamics(J, G, qd, qdd, G_EARTH),
            dynamics.forward_dynamics(M, bias, 1.0, qd, qdd),
            dynamics.energy(M, qd, now.masses, coms, G_EARTH),
        )

    given = [
        x.reshape(2, 3, *x.shape[1:])
        for x in (now.J, now.G, now.qd, now.qdd, now.coms_world)
    ]
    alone = everything(*(x[1, 2] for x in given))
    for many, single in zip(everything(*given), alone, strict=True):
        assert_same(many[1, 2], single, 1e-12)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: dynamics.mass_matrix(np.eye(7), np.ones((7, 6, 6)), 0.1),
            "J_space has",
        ),
        (lambda: dynamics.mass_matrix(np.ones((6, 7)), np.eye(6), 0.1), "G has shape"),
        (lambda: dynamics.mass_matrix(3.0, np.eye(6), 0.1), "J_space has shape"),
        (lambda: dynamics.spatial_inertia(1.0, [0, 0], np.eye(3)), "has shape"),
        (lambda: dynamics.spatial_inertia(np.nan, [0, 0, 0], np.eye(3)), "not finite"),
        (lambda: dynamics.bias_torque(*pendulum()[:2], [0.0, 0.0], G_EARTH), "qd has"),
        (lambda: dynamics.bias_torque(*pendulum()[:2], [0.0], -9.81), "expected a vec"),
    ],
)  # fmt: skip
def test_a_wrong_argument_is_named_with_what_was_expected(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_the_coriolis_matrix_times_qd_is_mujocos_bias_without_gravity(arm):
    model, now = arm
    C = dynamics.coriolis_matrix(now.J, now.G, now.qd)
    gravity = verify.mujoco_bias(model, now.q, 0 * now.qd)
    truth = verify.mujoco_bias(model, now.q, now.qd) - gravity
    assert_same((C @ now.qd[..., None])[..., 0], truth, 1e-12)


def test_the_mass_matrix_changes_by_the_coriolis_matrix_and_its_transpose(arm):
    model, now = arm
    h = 1e-5
    ahead = verify.mujoco_mass_matrix(model, now.q + h * now.qd)
    behind = verify.mujoco_mass_matrix(model, now.q - h * now.qd)
    C = dynamics.coriolis_matrix(now.J, now.G, now.qd)
    # So dM/dt - 2 C is C^T - C, which is skew-symmetric.
    assert_same(C + np.swapaxes(C, -1, -2), (ahead - behind) / (2 * h), 1e-7)


def test_the_coriolis_matrix_is_christoffels_of_mujocos_mass_matrix(arm):
    model, now = arm
    h = 1e-5
    q, qd = now.q[:10], now.qd[:10]
    rates = []  # of M along each joint
    for k in range(7):
        step = h * np.eye(7)[k]
        ahead = verify.mujoco_mass_matrix(model, q + step)
        behind = verify.mujoco_mass_matrix(model, q - step)
        rates.append((ahead - behind) / (2 * h))
    dM = np.stack(rates, axis=-1)  # [..., i, j, k] = dM_ij / dq_k
    symbols = (dM + np.swapaxes(dM, -1, -2) - np.moveaxis(dM, -1, -3)) / 2
    truth = (symbols @ qd[:, None, :, None])[..., 0]
    C = dynamics.coriolis_matrix(now.J[:10], now.G[:10], qd)
    assert_same(C, truth, 1e-6)


@given(arrays(np.float64, 7, elements=numbers))
def test_the_coriolis_matrix_is_linear_in_the_speed(qd):
    model = panda.load("panda_nohand")
    now = terms(model, panda.READY_Q[None])
    C = dynamics.coriolis_matrix(now.J, now.G, qd)
    assert_same(dynamics.coriolis_matrix(now.J, now.G, 2.0 * qd), 2.0 * C, 1e-12)
    assert not dynamics.coriolis_matrix(now.J, now.G, 0.0 * qd).any()

"""The hand's mass, springs and pushes against MuJoCo and by physics."""

import hypothesis.extra.numpy as hnp
import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import sqrtm

from robo47 import panda, simulate, task_space, verify

N = 100
wrenches = hnp.arrays(np.float64, 6, elements=st.floats(-20, 20))


def positive_definite(n):
    entries = hnp.arrays(np.float64, (n, n), elements=st.floats(-1, 1))
    return entries.map(lambda A: A @ A.T + 0.5 * np.eye(n))


@pytest.fixture(scope="module")
def states():
    """The arm at N configurations away from singularities, with MuJoCo beside it."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    q = verify.random_q(model, 3 * N, seed=6)
    sigma = [np.linalg.svd(arm.at(x).J_site, compute_uv=False)[-1] for x in q]
    q = q[np.array(sigma) > 0.05][:N]
    qd = np.random.default_rng(6).uniform(-1, 1, q.shape)
    return model, [(arm.at(x), xd) for x, xd in zip(q, qd, strict=True)]


def test_the_tutorial_cases_of_day_6():
    assert_same(task_space.task_inertia(np.eye(6), 2 * np.eye(6)), 2 * np.eye(6))
    spin = np.array([[0, 0, 1, 0, 0, 0.0]]).T
    assert_same(
        task_space.bias_acceleration(spin, [1.0], [1, 0, 0]), [0, 0, 0, -1.0, 0, 0]
    )
    assert_same(
        task_space.nullspace_torque([[1, 0]], np.eye(2), [[1]], [1, 1]), [0.0, 1.0]
    )
    e = [0, 0, 0, 0, 0, 0.025]
    F = task_space.impedance_wrench(e, np.zeros(6), 400 * np.eye(6), np.eye(6))
    assert F[5] == pytest.approx(10.0)
    assert_same(task_space.critical_damping([4.0], [[1.0]]), [[4.0]])
    assert task_space.set_point_for_force(20, 400, 0.42) == pytest.approx(0.37)
    down = task_space.hybrid_wrench(
        np.zeros(6), np.zeros(6), np.eye(6), np.eye(6), 10.0
    )
    assert_same(down, [0, 0, 0, 0, 0, -10.0])


def test_the_task_inertia_is_mujocos(states):
    model, arms = states
    for now, _ in arms:
        J = verify.mujoco_site_jacobian(model, now.q)
        truth = np.linalg.inv(
            J @ np.linalg.solve(verify.mujoco_mass_matrix(model, now.q), J.T)
        )
        ours = task_space.task_inertia(now.J_site, now.M)
        assert_same(ours, truth, 1e-10 * np.abs(truth).max())


def test_the_site_bias_is_the_rate_of_mujocos_jacobian(states):
    model, arms = states
    for now, qd in arms:
        ours = task_space.bias_acceleration(now.J_space, qd, now.T_world_ee[:3, 3])
        assert_same(ours, verify.mujoco_bias_acceleration(model, now.q, qd), 1e-9)


def test_osc_torque_gives_the_simulated_hand_the_wanted_acceleration(states):
    model, arms = states
    rng = np.random.default_rng(9)
    for now, qd in arms:
        acc = rng.uniform(-1, 1, 6)
        p = now.T_world_ee[:3, 3]
        drift = task_space.bias_acceleration(now.J_space, qd, p)
        Lambda = task_space.task_inertia(now.J_site, now.M)
        tau = task_space.osc_torque(now.J_site, Lambda, now.bias(qd), drift, acc)
        tau += 1.0 * qd  # what the joints' damping takes
        data = simulate.start(model, now.q, qd)
        data.qfrc_applied[:] = tau
        mujoco.mj_forward(model, data)  # fills qacc
        J = verify.mujoco_site_jacobian(model, now.q)
        ours = J @ data.qacc + verify.mujoco_bias_acceleration(model, now.q, qd)
        assert_same(ours, acc, 1e-8)


def test_the_null_torque_does_not_move_the_hand_but_a_kinematic_projector_does(states):
    _, arms = states
    tau = np.random.default_rng(10).uniform(-5, 5, 7)
    kinematic = []
    for now, _ in arms:
        J, M = now.J_site, now.M
        ours = task_space.nullspace_torque(J, M, task_space.task_inertia(J, M), tau)
        assert_same(J @ np.linalg.solve(M, ours), np.zeros(6), 1e-10)
        wrong = tau - np.linalg.pinv(J) @ (J @ tau)
        kinematic.append(np.abs(J @ np.linalg.solve(M, wrong)).max())
    assert np.median(kinematic) > 1.0  # m/s2 or rad/s2


@given(hnp.arrays(np.float64, (3, 7), elements=st.floats(-1, 1)), positive_definite(7))
def test_projecting_twice_is_projecting_once(A, M):
    J = A + np.eye(3, 7) * 3.0  # of full rank
    tau = np.arange(7.0)
    Lambda = task_space.task_inertia(J, M)
    once = task_space.nullspace_torque(J, M, Lambda, tau)
    assert_same(task_space.nullspace_torque(J, M, Lambda, once), once, 1e-9)


@given(positive_definite(6), positive_definite(7))
def test_the_task_inertia_is_symmetric_and_the_hand_is_never_free_of_mass(A, M):
    J = np.hstack([A, np.ones((6, 1))])
    Lambda = task_space.task_inertia(J, M)
    assert_same(Lambda, Lambda.T)
    assert np.linalg.eigvalsh(Lambda).min() > 0.0
    assert_same(
        Lambda @ J @ np.linalg.inv(M) @ J.T, np.eye(6), 1e-8 * np.linalg.cond(Lambda)
    )


@given(hnp.arrays(np.float64, 6, elements=st.floats(0.0, 1000)), positive_definite(6))
def test_critical_damping_is_scipys_square_roots(K, Lambda):
    root, k = sqrtm(Lambda).real, np.diag(np.sqrt(K))
    ours = task_space.critical_damping(K, Lambda)
    assert_same(ours, root @ k + k @ root, 1e-8)
    assert_same(ours, ours.T, 1e-12)


@given(wrenches, wrenches, st.floats(0, 50))
def test_hybrid_is_the_spring_but_for_its_last_row(e, V_err, force):
    K, D = 100.0 * np.eye(6), np.diag(np.arange(1.0, 7.0))
    spring = task_space.impedance_wrench(e, V_err, K, D)
    hybrid = task_space.hybrid_wrench(e, V_err, K, D, force)
    assert_same(hybrid[:5], spring[:5])
    assert hybrid[5] == pytest.approx(6.0 * V_err[5] - force)


@given(wrenches, wrenches)
def test_impedance_torque_does_the_wrenchs_work(wrench, qd6):
    rng = np.random.default_rng(3)
    J, bias, tau_null = rng.normal(size=(6, 7)), rng.normal(size=7), rng.normal(size=7)
    qd = np.append(qd6, 1.0)
    tau = task_space.impedance_torque(J, wrench, bias, 1.5, qd, tau_null)
    # Power: what is left of the torque moves the hand against the wrench.
    power = (tau - bias - 1.5 * qd - tau_null) @ qd
    assert power == pytest.approx(wrench @ (J @ qd), rel=1e-9, abs=1e-9)


def test_many_configurations_at_once_equal_one_at_a_time(states):
    _, arms = states
    arms = arms[:5]
    J = np.array([now.J_site for now, _ in arms])
    J_space = np.array([now.J_space for now, _ in arms])
    M = np.array([now.M for now, _ in arms])
    qd = np.array([qd for _, qd in arms])
    p = np.array([now.T_world_ee[:3, 3] for now, _ in arms])
    Lambda = task_space.task_inertia(J, M)
    drift = task_space.bias_acceleration(J_space, qd, p)
    tau = task_space.nullspace_torque(J, M, Lambda, qd)
    D = task_space.critical_damping(np.ones(6), Lambda)
    for i in range(5):
        assert_same(Lambda[i], task_space.task_inertia(J[i], M[i]), 1e-10)
        assert_same(
            drift[i], task_space.bias_acceleration(J_space[i], qd[i], p[i]), 1e-12
        )
        one = task_space.nullspace_torque(J[i], M[i], Lambda[i], qd[i])
        assert_same(tau[i], one, 1e-10)
        assert_same(D[i], task_space.critical_damping(np.ones(6), Lambda[i]), 1e-12)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: task_space.task_inertia(np.zeros((6, 7)), np.eye(7)), "singularity"),
        (lambda: task_space.task_inertia(np.ones((6, 7)), np.eye(6)), "M has shape"),
        (
            lambda: task_space.bias_acceleration(np.eye(7), np.ones(7), np.ones(3)),
            "J_space has",
        ),
        (lambda: task_space.critical_damping([1, 1], -np.eye(2)), "positive definite"),
        (lambda: task_space.critical_damping([-1, 1], np.eye(2)), "K is -1"),
        (lambda: task_space.set_point_for_force(1, 0, 0), "k is 0; it must be above 0"),
        (
            lambda: task_space.impedance_wrench([0] * 6, [0] * 6, [1] * 6, np.eye(6)),
            r"K has shape \(6,\); expected \(..., 6, 6\)",
        ),
    ],
)
def test_what_is_wrong_is_named_in_one_line(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)

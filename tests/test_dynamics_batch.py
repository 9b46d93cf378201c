"""Dynamics of many configurations at once: MuJoCo's numbers, for any arm of hinges."""

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st

from robo47 import panda, se3, verify
from robo47.arm import Arm
from robo47.fast import chains, dynamics
from robo47.fast.jacobians import jacobians

pytestmark = pytest.mark.kit

N = 300


@pytest.fixture
def motions(either_panda):
    rng = np.random.default_rng(12)
    q = verify.random_q(either_panda, N, seed=12)
    qd, qdd = rng.uniform(-2, 2, q.shape), rng.uniform(-10, 10, q.shape)
    return either_panda, panda.arm(either_panda), q, qd, qdd


def test_mass_matrices_jacobians_and_torques_are_mujocos(motions):
    model, arm, q, qd, qdd = motions
    M, J = dynamics.mass_matrix(arm, q), jacobians(arm.screws, arm.M_home, q, True)
    assert_same(M, verify.mujoco_mass_matrix(model, q), 1e-13)
    assert_same(J, verify.mujoco_site_jacobian(model, q), 1e-14)
    tau = dynamics.inverse_dynamics(arm, q, qd, qdd)
    tau += arm.armature * qdd + arm.damping * qd
    truth = verify.mujoco_inverse_dynamics(model, q, qd, qdd)
    assert_same(tau, truth, 1e-12)


def test_the_pandas_links_need_no_fixed_rotation(either_panda):
    """Every axis of it is one of the world's at q = 0: that is where the speed is."""
    links = dynamics.links_of(panda.arm(either_panda))
    assert all(link.R is None for link in links)
    assert [link.k for link in links] == [2, 1, 2, 1, 2, 1, 2]
    assert [link.sign for link in links] == [1, 1, 1, -1, 1, -1, -1]


def any_arm(seed, n):
    """Return an arm of n hinges about lines anywhere, with bodies of any inertia."""
    rng = np.random.default_rng(seed)
    omega = rng.normal(size=(n, 3))
    omega /= np.linalg.norm(omega, axis=1, keepdims=True)
    omega[rng.random(n) < 0.3] = rng.permutation(np.eye(3))[0] * rng.choice([-1, 1])
    roots = rng.normal(size=(n, 3, 3))
    T_zero = se3.make_T(
        se3.axis_angle(rng.normal(size=(n, 3)), 1.0), rng.normal(size=(n, 3))
    )
    return Arm(
        screws=np.hstack([omega, np.cross(rng.normal(size=(n, 3)), omega)]),
        M_home=se3.make_T(se3.axis_angle([1.0, 2.0, 3.0], 2.0), rng.normal(size=3)),
        T_zero=T_zero,
        masses=rng.uniform(0.1, 3.0, n),
        coms=rng.normal(size=(n, 3)),
        inertias=roots @ np.swapaxes(roots, -1, -2),
        armature=rng.uniform(0.0, 0.3, n),
        damping=0.0,
        gravity=rng.normal(size=3),
    )


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**6), st.integers(1, 8))
def test_any_arm_of_hinges_gives_what_arm_gives_one_by_one(seed, n):
    arm = any_arm(seed, n)
    q, qd, qdd = np.random.default_rng(seed).normal(size=(3, 4, n))
    M = dynamics.mass_matrix(arm, q)
    tau = dynamics.inverse_dynamics(arm, q, qd, qdd)
    J = jacobians(arm.screws, arm.M_home, q, at_end=True)
    for i in range(4):
        now = arm.at(q[i])
        scale = max(1.0, np.abs(now.M).max())
        assert_same(M[i], now.M, 1e-12 * scale)
        own = (now.M - np.diag(arm.armature)) @ qdd[i] + now.bias(qd[i])
        assert_same(tau[i], own, 1e-11 * scale)
        assert_same(J[i], now.J_site, 1e-12)


def test_chunks_and_shapes_make_no_difference(twin, monkeypatch):
    arm = panda.arm(panda.load())
    rng = np.random.default_rng(3)
    q, qd, qdd = rng.normal(size=(3, 2, 5, 7))
    whole = dynamics.inverse_dynamics(arm, q, qd, qdd)
    monkeypatch.setattr(chains, "CHUNK", 3)
    assert_same(dynamics.inverse_dynamics(arm, q, qd, qdd), whole, 1e-12)
    assert dynamics.mass_matrix(arm, q).shape == (2, 5, 7, 7)
    one = dynamics.inverse_dynamics(arm, q[1, 2], qd[1, 2], qdd[1, 2])
    assert_same(one, whole[1, 2], 1e-12)
    same_speed = dynamics.inverse_dynamics(arm, q, qd[0, 0], np.zeros(7))
    assert same_speed.shape == (2, 5, 7)
    assert dynamics.mass_matrix(arm, np.zeros((0, 7))).shape == (0, 7, 7)


def test_what_is_not_for_the_batch_is_refused(twin):
    arm = panda.arm(panda.load())
    with pytest.raises(ValueError, match="q has shape"):
        dynamics.mass_matrix(arm, np.zeros((3, 6)))
    with pytest.raises(ValueError, match="qd holds a number that is not finite"):
        dynamics.inverse_dynamics(arm, np.zeros(7), [np.nan] * 7, np.zeros(7))
    slide = Arm(
        screws=[[0, 0, 0, 1, 0, 0]], M_home=np.eye(4), T_zero=np.eye(4)[None],
        masses=[1.0], coms=np.zeros((1, 3)), inertias=np.eye(3)[None],
        armature=0.0, damping=0.0,
    )  # fmt: skip
    with pytest.raises(ValueError, match="joint 1 is no hinge"):
        dynamics.mass_matrix(slide, [0.0])

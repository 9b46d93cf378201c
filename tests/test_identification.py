"""Identification against MuJoCo, Pinocchio, SciPy, NumPy, Day 4 and worked cases."""

import json
import re
from pathlib import Path

import mujoco
import numpy as np
import pytest
import scipy.linalg
from compare import assert_same

from robo47 import dynamics, identification, panda, verify
from robo47.screws import ad

import day8_mujoco

DATA = Path(__file__).parent / "data"
G_EARTH = np.array([0.0, 0.0, -9.81])
rng = np.random.default_rng(8)


def bodies(n=20):
    """Return masses, centres and inertias of n bodies of 40 points each."""
    points, weights = rng.normal(size=(n, 40, 3)), rng.uniform(0.1, 1, (n, 40))
    m = weights.sum(axis=1)
    c = (weights[..., None] * points).sum(axis=1) / m[:, None]
    d = points - c[:, None]
    P = np.einsum("nk,nki,nkj->nij", weights, d, d)
    return m, c, np.trace(P, axis1=1, axis2=2)[:, None, None] * np.eye(3) - P


def columns(arm, q, qd, qdd):
    """Return Y of the links at q, (n, 7, 70), and the 70 numbers of the arm."""
    now = [arm.at(x) for x in q]
    J, T = np.array([x.J_space for x in now]), np.array([x.T_links for x in now])
    Y = identification.arm_regressor(J, T, qd, qdd, arm.gravity)
    return Y, day8_mujoco.numbers(arm)[:70]


def deficient():
    """Return a matrix, (30, 8), of rank 5, and a vector beside it."""
    left, right = rng.normal(size=(30, 5)), rng.normal(size=(5, 8))
    return left @ right, rng.normal(size=30)


def test_ten_numbers_are_day_4s_inertia_and_their_regressor_newton_and_eulers_wrench():
    body = bodies()
    phi, G = identification.inertial_parameters(*body), dynamics.spatial_inertia(*body)
    assert_same(identification.spatial_inertia_from_params(phi), G, 1e-12)
    V, A = rng.normal(size=(2, 20, 6))
    turned = np.swapaxes(ad(V), 1, 2) @ G @ V[..., None]
    Y = identification.link_regressor(V, A)
    assert_same(Y @ phi[..., None], G @ A[..., None] - turned, 1e-12)


def test_the_arms_regressor_is_mj_inverse_on_either_panda(either_panda):
    arm, motion = panda.arm(either_panda), day8_mujoco.anywhere(either_panda, 8, 50)
    Y, phi = columns(arm, *motion)
    motors = identification.actuator_regressor(motion.qd, motion.qdd)
    friction = np.concatenate([arm.armature, arm.damping, np.zeros(7)])
    tau = verify.mujoco_inverse_dynamics(either_panda, *motion)
    assert_same(Y @ phi + motors @ friction, tau, 1e-11)


def test_pinocchio_agrees(either_panda):
    kept = json.loads((DATA / "dynamics_oracle.json").read_text())["panda_nohand"]
    q, qd, qdd = (np.array(kept[name]) for name in ("q", "qd", "qdd"))
    arm = panda.arm(either_panda)
    Y, phi = columns(arm, q, qd, qdd)
    # MuJoCo 3 reproduces the file's inertias, which Pinocchio reads, to 5e-7.
    tol = 1e-4 if mujoco.__version__.startswith("3.") else 1e-12
    assert_same(Y @ phi + arm.armature * qdd, np.array(kept["rnea"]), tol)


def test_rank_and_fit_are_those_of_numpy_and_scipy():
    Y, tau = deficient()
    rank, condition = identification.rank_and_condition(Y, 1e-9)
    s = scipy.linalg.svdvals(Y)
    assert rank == np.linalg.matrix_rank(Y) == 5
    assert condition == pytest.approx(s[0] / s[4])
    phi = identification.truncated_svd_fit(Y, tau, 1e-9)
    assert_same(phi, scipy.linalg.lstsq(Y, tau, cond=1e-9)[0], 1e-12)


def test_sigma_is_how_far_predictions_scatter():
    (Y, _), predict = deficient(), identification.predict_with_sigma
    phi, Y_new = rng.normal(size=8), rng.normal(size=(4, 5)) @ np.linalg.svd(Y)[2][:5]
    noises = 0.1 * rng.normal(size=(2000, 30))
    both = np.array([predict(Y, Y @ phi + noise, Y_new, 1e-9) for noise in noises])
    torques, sigmas = both[:, 0], both[:, 1]
    said = np.sqrt(np.mean(sigmas**2, axis=0))
    assert_same(said / np.std(torques, axis=0), np.ones(4), 0.06)
    one = predict(np.ones((4, 1)), [1, 3, 1, 3], [[1]], 1e-9)
    assert_same(one, [[2.0], [1 / np.sqrt(3)]], 1e-12)


def test_a_load_is_weighed_to_rounding_where_nothing_rubs():
    model = panda.load("panda_nohand", drive="torque")
    com = np.array([0.02, -0.03, 0.06])
    loaded = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(0.5, com))
    q = verify.random_q(model, 6, 8)
    extra = verify.mujoco_bias(loaded, q, 0 * q) - verify.mujoco_bias(model, q, 0 * q)
    J, R = day8_mujoco.hands(panda.arm(model), q)
    found = identification.identify_payload(J, R, extra, G_EARTH)
    assert_same(found, [0.5, *0.5 * com], 1e-13)


def test_points_make_a_body_and_a_positive_inertia_may_not():
    phi = identification.inertial_parameters(*bodies())
    assert identification.min_pseudo_inertia_eig(phi).min() > 0.0
    point = identification.inertial_parameters(2.0, [1.0, 2, 3], np.zeros((3, 3)))
    assert_same(identification.min_pseudo_inertia_eig(point), 0.0, 1e-13)
    none = [1, 0, 0, 0, 1, 1, 3, 0, 0, 0]
    assert (
        np.linalg.eigvalsh(identification.spatial_inertia_from_params(none)).min() > 0.0
    )
    assert identification.min_pseudo_inertia_eig(none) == pytest.approx(-0.5)


REFUSED = {
    "phi has shape (9,)": (identification.spatial_inertia_from_params, np.ones(9)),
    "stack": (identification.truncated_svd_fit, np.ones((2, 3, 4)), np.ones(2), 0.1),
    "nothing": (identification.truncated_svd_fit, np.zeros((3, 2)), np.ones(3), 0.1),
    "2 rows leave": (identification.predict_with_sigma, np.eye(2), [1, 1], [[1, 0]], 0),
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_wrong_argument_is_named(words):
    function, *arguments = REFUSED[words]
    with pytest.raises(ValueError, match=re.escape(words)):
        function(*arguments)

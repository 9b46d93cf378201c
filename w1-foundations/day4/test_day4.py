"""Day 4: the numbers in the guide's sentences on M, inverses and the integrator."""

import re
import sys

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, sentences
from robo47 import dynamics, panda, verify

import day4_mujoco

GUIDE = (ROOT / "w1-foundations/docs/day4-lab.md").read_text("utf-8")
SENTENCES = sentences(4)
lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")


@pytest.fixture(scope="module")
def arm():
    return panda.arm(panda.load("panda_nohand"))


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand", drive="torque")


def mass_matrices(arm, model):
    """Return, at the lab's own q, MuJoCo's M and {mistake: M}."""
    q = verify.random_q(model, lab.TRIALS - 1, lab.SEED)
    q = np.vstack([panda.READY_Q, q])
    wrong = {}
    for x in q:
        now = arm.at(x)
        bad = day4_mujoco.wrong_on_purpose(
            lab.link_inertias, now.T_links, *panda.inertias(model)
        )
        for what, G in bad.items():
            M = lab.mass_matrix(now.J_space, G, arm.armature)
            wrong.setdefault(what, []).append(M)
    return verify.mujoco_mass_matrix(model, q), {
        k: np.array(v) for k, v in wrong.items()
    }


def test_a_mass_matrix_with_a_wrong_sign_is_symmetric_and_positive_definite(arm, model):
    truth, wrong = mass_matrices(arm, model)
    M = wrong["m [c] with the wrong sign"]
    assert_same(M, np.swapaxes(M, 1, 2), 1e-13)
    least = np.linalg.eigvalsh(M).min()
    off = np.abs(M - truth).max()
    assert f"wrong by {off:.3f} kg m²" in SENTENCES
    assert f"smallest eigenvalue of the wrong M is {least:.3f}" in SENTENCES
    assert f"entry of all 100 correct matrices ({truth.max():.3f} kg m²)" in SENTENCES
    assert 5.0 < off / truth.max() < 6.0  # "more than five times"
    least = {what: np.linalg.eigvalsh(one).min() for what, one in wrong.items()}
    caught = [what for what, value in least.items() if value < 0]
    assert caught == ["m [c] [c]^T omitted"]
    values = np.linalg.eigvalsh(wrong[caught[0]])
    assert (values.min(axis=1) < 0).all()
    assert "at each of the 100 configurations" in SENTENCES
    assert f"with an eigenvalue of {least[caught[0]]:.3f} the kinetic" in SENTENCES


@pytest.mark.kit
def test_the_form_finds_the_same_mistake_with_twelve_other_sets(arm, model):
    factors = []
    for seed in range(12):
        at = day4_mujoco.motions(model, 100, seed, 1.0, 1.0)
        truth = verify.mujoco_mass_matrix(model, at.q)
        found = day4_mujoco.wrong_masses(lab.link_inertias, lab.mass_matrix, at, truth)
        assert [k for k, v in found.items() if v.least < 0] == ["m [c] [c]^T omitted"]
        factors.append(found["m [c] with the wrong sign"].off / truth.max())
    assert 5.2 < min(factors) < max(factors) < 5.6


def test_the_wrong_sign_is_an_arm_with_its_masses_at_minus_c(arm):
    now = arm.at(panda.READY_Q)
    flip = np.diag([1.0, 1, 1, -1, -1, -1])
    body = (arm.masses, arm.coms, arm.inertias)
    R = now.T_links[:, :3, :3]
    wrong = day4_mujoco.wrong_on_purpose(lab.link_inertias, now.T_links, *body)[
        "m [c] with the wrong sign"
    ]
    own = R @ arm.inertias @ np.swapaxes(R, 1, 2)
    across = map(lab.spatial_inertia, arm.masses, -now.coms_world, own)
    assert_same(wrong, list(across), 1e-14)
    # An arm that is mirrored as a whole, joints and all, has our M.
    mirrored = lab.mass_matrix(flip @ now.J_space, wrong, arm.armature)
    assert_same(mirrored, now.M, 1e-14)
    assert "whose centres of mass sit at $-c$" in SENTENCES


def test_at_q_zero_M_does_not_see_which_way_I_was_turned(arm):
    def off(q, com, own):
        now = arm.at(q)
        m, c, inertia = arm.masses, arm.coms, arm.inertias
        R = now.T_links[:, :3, :3]
        p = now.T_links[:, :3, 3]
        c = np.einsum(com, R, c) + p
        G = dynamics.spatial_inertia(m, c, np.einsum(own, R, inertia, R))
        return np.abs(lab.mass_matrix(now.J_space, G, arm.armature) - now.M).max()

    says = "at q = 0, $R I R^T$ and $R^T I R$ give the same M"
    assert says in SENTENCES
    assert off(np.zeros(7), "nij,nj->ni", "nji,njk,nkl->nil") < 1e-12
    assert off(panda.READY_Q, "nij,nj->ni", "nji,njk,nkl->nil") > 1e-3
    assert off(np.zeros(7), "nji,nj->ni", "nji,njk,nkl->nil") > 0.4  # c shows


def test_the_answers_on_paper_are_those_of_the_functions():
    S = np.array([[0.0, 1, 0, 0, 0, 0]]).T
    c = np.array([1.0, 0, 0])
    g = np.array([0.0, 0, -9.81])
    G = lab.spatial_inertia(1.0, c, np.zeros((3, 3)))
    assert_same(G[:3, :3], np.diag([0.0, 1, 1]), 0.0)
    assert_same(G[:3, 3:], -G[3:, :3], 0.0)
    held = lab.gravity_torque(S, np.ones(1), c[None], g)
    M = lab.mass_matrix(S, G[None], np.zeros(1))
    faster = lab.inverse_dynamics(S, G[None], np.zeros(1), np.ones(1), g)
    for answer, says in (
        (held[0], f"that holds it is negative: {held[0]:.2f} N m"),
        (M[0, 0], f"The entry is {M[0, 0]:.0f} kg m²: with"),
        (faster[0], f"is now {faster[0]:.2f} N m. The mass"),
    ):
        assert says in SENTENCES, answer


def test_the_stone_of_step_5_is_pulled_inwards_by_the_second_term(arm):
    G = lab.spatial_inertia(1.0, np.array([1.0, 0, 0]), np.zeros((3, 3)))
    V = np.array([0.0, 0, 1, 0, 0, 0])
    assert_same(G @ V, [0, 0, 1, 0, 1, 0], 0.0)
    assert_same(-lab.ad(V).T @ G @ V, [0, 0, 0, -1, 0, 0], 0.0)
    for words in ("is (0, 0, 1; 0, 1, 0)", "as (0, 0, 0; -1, 0, 0)"):
        assert words in SENTENCES
    # The law behind it: G rides on its link, so its rate is -ad(V)^T G - G ad(V).
    V = np.random.default_rng(2).normal(size=6)
    h = 1e-6
    X = np.eye(6) - h * lab.ad(V)  # takes what rides on the link back by h
    rate = (X.T @ G @ X - G) / h
    assert_same(rate, -lab.ad(V).T @ G - G @ lab.ad(V), 1e-4)


def test_two_coriolis_matrices_give_one_torque_and_one_of_them_a_skew_rest(arm):
    code = re.search(r"```python\n(q, qd, h.*?)```", GUIDE, re.S)[1]
    rows = []
    space = {"READY_Q": lab.READY_Q, "arm": arm, "np": np}
    exec(code, {**space, "print": lambda *numbers: rows.append(numbers)})
    for torque, power, _ in rows:
        assert torque < 1e-9
        assert abs(power) < 1e-12
    assert rows[0][2] < 1e-12
    assert f"symmetric part of up to {rows[1][2]:.2f} kg m²/s" in SENTENCES
    # The error of the torque belongs to the differences, not to rounding.
    rows.clear()
    for h in ("1e-3", "1e-4"):
        exec(code.replace("1e-5", h), {**space, "print": lambda *new: rows.append(new)})
    assert rows[0][0] / rows[2][0] == pytest.approx(100, rel=0.05)
    assert "a hundred times the error with h = 1e-4" in SENTENCES


def test_M_plus_h_D_belongs_to_a_step_that_brakes_at_its_end(arm):
    model = panda.load("panda_nohand", drive="torque")
    q = verify.random_q(model, 20, seed=1)
    h = model.opt.timestep
    rng = np.random.default_rng(1)
    qd, tau = rng.uniform(-2, 2, q.shape), rng.uniform(-10, 10, q.shape)

    def off(damped):
        own = []
        for i, now in enumerate(map(arm.at, q)):
            M = now.M + damped * np.diag(arm.damping)
            bias = now.bias(qd[i])
            qdd = lab.forward_dynamics(M, bias, arm.damping, qd[i], tau[i])
            own.append(qd[i] + h * qdd)
        return np.abs(own - verify.mujoco_step(model, q, qd, tau)).max()

    assert off(h) < 1e-12
    assert off(0.0) > 1e-3  # the guide's number is that of the lab's own states
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_EULERDAMP
    assert off(0.0) < 1e-12  # it brakes with the velocity at the start
    assert off(h) > 1e-3


def test_the_inverse_of_M_fits_the_equation_less_well(arm, model):
    left = np.zeros(2)
    rng = np.random.default_rng(1)
    for q in verify.random_q(model, 300, seed=3):
        M = arm.at(q).M
        tau = rng.uniform(-50, 50, 7)
        for i, qdd in enumerate((np.linalg.solve(M, tau), np.linalg.inv(M) @ tau)):
            left[i] += np.abs(M.astype(np.longdouble) @ qdd - tau).max()
    assert left[1] > 1.2 * left[0]  # measured 1.5
    assert "satisfies the equation less accurately" in SENTENCES


def test_rk4_asks_four_times_a_step(model):
    asked = []
    mujoco.set_mjcb_passive(lambda model, data: asked.append(1))
    try:
        for name, times in (("IMPLICITFAST", 1), ("RK4", 4)):
            model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{name}")
            mujoco.mj_step(model, mujoco.MjData(model), 10)
            assert len(asked) == 10 * times
            asked.clear()
    finally:
        mujoco.set_mjcb_passive(None)
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    assert "costs four times as much" in SENTENCES


def test_the_integrator_loses_energy_in_proportion_to_its_step():
    first, half = (day4_mujoco.swing("IMPLICITFAST", step) for step in (0.002, 0.001))
    assert 1.8 < first / half < 2.2
    assert abs(day4_mujoco.swing("RK4", 0.002)) < 1e-6 * abs(first)


@pytest.mark.kit
def test_from_most_starts_the_integrator_gains_energy_and_RK4_hardly_changes_it(model):
    gains = []
    for q in verify.random_q(model, 12, seed=1):
        gains.append(day4_mujoco.swing("IMPLICITFAST", 0.002, q))
        exact = day4_mujoco.swing("RK4", 0.002, q)
        assert abs(exact) < 1e-5 * abs(gains[-1])
    assert sum(gain > 0 for gain in gains) > 8  # measured 11 of 12


def test_the_script_runs_as_a_person_runs_it(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["day4_dynamics.py", "--no-log"])
    monkeypatch.setattr(lab, "TRIALS", 10)
    monkeypatch.setattr(lab, "LIBRARY_TRIALS", 10)
    assert lab.main() == 0
    out = capsys.readouterr().out
    assert "All checks PASSED." in out
    assert max(map(len, out.splitlines())) <= 80

"""Day 4's rows of the errata."""

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from robo47 import dynamics, panda, simulate, verify

PAGE = (ROOT / "w1-foundations/docs/errata.md").read_text("utf-8")
ERRATA = PAGE.partition("\n## Day 4\n")[2].partition("\n## ")[0]
lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")


@pytest.fixture(scope="module")
def arm():
    return panda.arm(panda.load("panda_nohand"))


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand", drive="torque")


def test_every_row_names_a_test_of_this_file():
    rows = [line for line in ERRATA.splitlines() if line.startswith("| ")][1:]
    assert len(rows) == 3
    for row in rows:
        assert row.rstrip("| ").split("`")[-2] in globals(), row


def test_mj_rne_leaves_out_armature_and_damping(arm, model):
    rng = np.random.default_rng(5)
    data = mujoco.MjData(model)
    for q in verify.random_q(model, 20, seed=5):
        data.qpos[:] = q
        data.qvel[:], data.qacc[:] = rng.uniform(-2, 2, 7), rng.uniform(-10, 10, 7)
        mujoco.mj_inverse(model, data)
        rne = np.zeros(7)
        mujoco.mj_rne(model, data, 1, rne)
        extra = 0.1 * data.qacc + 1.0 * data.qvel
        assert_same(data.qfrc_inverse - rne, extra, 1e-11)
        now = arm.at(q)
        G = lab.link_inertias(now.T_links, arm.masses, arm.coms, arm.inertias)
        ours = dynamics.inverse_dynamics(
            now.J_space, G, data.qvel, data.qacc, arm.gravity
        )
        assert_same(rne, ours, 1e-11)


def test_without_armature_and_damping_the_two_inverses_agree():
    model = panda.load("panda_nohand", drive="torque")
    model.dof_armature[:] = model.dof_damping[:] = 0.0
    data = mujoco.MjData(model)
    rne = np.zeros(7)
    data.qpos[:] = panda.READY_Q
    data.qvel[:] = 1.5
    data.qacc[:] = 5.0
    mujoco.mj_inverse(model, data)
    mujoco.mj_rne(model, data, 1, rne)
    assert_same(data.qfrc_inverse, rne, 1e-11)


def departure(arm, model, torque):
    """Return how far errors are from (1 + wt) e^-wt, in parts of what they were."""
    omega = 20.0
    start = 0.1 * np.array([1, -1, 1, 1, -1, 1, -1.0])

    def controller(t, q, qd):
        now = arm.at(q)
        e = panda.READY_Q - q
        wanted = omega**2 * e - 2 * omega * qd
        return torque(now.M, wanted) + now.bias(qd) + arm.damping * qd

    data = simulate.start(model, panda.READY_Q - start)
    run = simulate.run(model, data, controller, 0.6, rate=500.0)
    predicted = (1 + omega * run.t) * np.exp(-omega * run.t)
    return np.abs((panda.READY_Q - run.q) / start - predicted[:, None]).max()


def test_gains_outside_M_do_not_give_the_error_that_was_asked_for(arm, model):
    inside = departure(arm, model, lambda M, wanted: M @ wanted)
    outside = departure(arm, model, lambda M, wanted: wanted)
    assert inside < 0.02
    assert outside > 0.1


def test_the_mass_matrix_needs_no_mj_fullM(model):
    assert "mj_fullM" in ERRATA
    if tuple(map(int, mujoco.__version__.split(".")[:2])) >= (3, 10):
        data = mujoco.MjData(model)
        dense = np.zeros((7, 7))
        mujoco.mj_forward(model, data)
        with pytest.raises((TypeError, AttributeError)):
            mujoco.mj_fullM(model, dense, data.qM)
    M = verify.mujoco_mass_matrix(model, panda.READY_Q)
    assert_same(M, M.T, 1e-14)

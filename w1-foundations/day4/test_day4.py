"""Day 4: the numbers in the guide's sentences, the demo, and the errata rows."""

import importlib.util
import re
import sys

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import dynamics, panda, simulate, verify

import day4_mujoco
from day3_mujoco import beyond

GUIDE = (ROOT / "w1-foundations/docs/day4-lab.md").read_text("utf-8")
PAGE = (ROOT / "w1-foundations/docs/errata.md").read_text("utf-8")
ERRATA = PAGE.partition("\n## Day 4\n")[2].partition("\n## ")[0]
SENTENCES = " ".join(re.sub(r"<!-- run.*?<!-- end -->", "", GUIDE, flags=re.S).split())
lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")
DOWN = np.array([0.0, 0.0, -9.81])


@pytest.fixture(scope="module")
def arm():
    return panda.arm(panda.load("panda_nohand"))


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand", drive="torque")


def mass_matrices(arm, model):
    """Return, at the lab's own q, MuJoCo's M and {what is wrong: M}."""
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
    assert f"its least eigenvalue is {least:.3f}" in SENTENCES
    assert f"entry of all 100 M ({truth.max():.3f})" in SENTENCES
    assert 5.0 < off / truth.max() < 6.0  # "over five times"
    least = {what: np.linalg.eigvalsh(one).min() for what, one in wrong.items()}
    caught = [what for what, value in least.items() if value < 0]
    assert caught == ["m [c] [c]^T forgotten"]
    assert f"no mass matrix has an eigenvalue of {least[caught[0]]:.3f}" in SENTENCES


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

    assert "q = 0 M does not see which way the inertia I was turned" in SENTENCES
    assert off(np.zeros(7), "nij,nj->ni", "nji,njk,nkl->nil") < 1e-12
    assert off(panda.READY_Q, "nij,nj->ni", "nji,njk,nkl->nil") > 1e-3
    assert off(np.zeros(7), "nji,nj->ni", "nji,njk,nkl->nil") > 0.4  # c shows


def test_gravity_at_ready_and_what_the_arm_weighs(arm):
    tau = arm.at(panda.READY_Q).gravity_torque
    assert f"{tau[3]:.3f} N m, of the 87" in SENTENCES
    assert abs(tau[0]) < 1e-12  # "joint1 holds nothing", since its axis is upright
    now = arm.at(panda.READY_Q)
    tipped = 9.81 * np.array([0, np.sin(0.1), -np.cos(0.1)])
    tau = lab.gravity_torque(now.J_space, arm.masses, now.coms_world, tipped)
    assert f"0.1 rad to the side, and it holds {abs(tau[0]):.1f} N m" in SENTENCES
    assert f"a {arm.masses.sum():.0f} kg arm" in SENTENCES


def test_the_arm_floats_and_falls_as_the_guide_says(arm, model):
    calm = 0 * lab.PUSH

    def moved(share, seconds):
        path = lab.let_go(model, arm, share, (seconds, calm))
        return np.linalg.norm(path[-1] - path[0])

    after = "after half a second the hand is"
    assert f"{after} {1000 * moved(0.0, 0.5):.0f} mm away" in SENTENCES
    assert f"99 % of gravity, {1000 * moved(0.99, 2.0):.0f} mm in two" in SENTENCES
    assert moved(1.0, 5.0) < 1e-12  # "less than a picometre"


@pytest.mark.parametrize(("newtons", "hits"), [(10.0, False), (50.0, True)])
def test_50_n_drive_the_arm_into_its_limits_and_10_do_not(arm, model, newtons, hits):
    law = lambda t, q, qd: arm.at(q).gravity_torque  # noqa: E731
    push = simulate.push_at("attachment_site", [0, 0, 0, 0, newtons, 0])
    data = simulate.start(model, panda.READY_Q)
    runs = [simulate.run(model, data, law, seconds, rate=lab.RATE, push=given)
            for seconds, given in ((0.5, push), (4.5, None))]  # fmt: skip
    assert (beyond(model.jnt_range, np.vstack([r.q for r in runs])) > 0) == hits


def test_without_torque_a_joint_is_at_its_limit_after_a_quarter_of_a_second(model):
    data = simulate.start(model, panda.READY_Q)
    while beyond(model.jnt_range, data.qpos[None]) <= 0:
        mujoco.mj_step(model, data)
    assert data.time == pytest.approx(0.25, abs=0.01)
    assert "at a joint limit after a quarter of a second" in SENTENCES


def test_the_arm_glides_when_it_is_pushed(arm, model):
    calm = 0 * lab.PUSH
    path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, calm))
    speed = np.linalg.norm(np.diff(path, axis=0), axis=1) * lab.RATE
    assert f"up to {speed.max():.2f} m/s" in SENTENCES
    pushed = round(0.5 * lab.RATE)
    assert path[pushed, 1] - path[0, 1] > 0.1  # along +y, and on round the base
    assert np.linalg.norm(path[-1] - path[0]) > 0.5
    assert f"still does {speed[-1]:.3f} m/s" in SENTENCES


def test_it_is_the_damping_that_slows_the_pushed_arm_down(arm):
    ends = []
    for share in (1.0, 0.5, 0.0):
        model = panda.load("panda_nohand", drive="torque")
        model.dof_damping[:] *= share
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        ends.append(np.linalg.norm(path[-1] - path[-2]) * lab.RATE)
    assert ends[1] > 4 * ends[0]
    assert ends[2] > 3 * ends[1]


def test_with_M_alone_the_next_velocity_is_off_by_what_the_guide_says():
    model = panda.load("panda_nohand", drive="torque")
    now = lab.day4_mujoco.motions(model, 100, lab.SEED, lab.FASTEST, lab.HARDEST)
    share = np.random.default_rng(lab.TRIALS).uniform(-0.5, 0.5, now.q.shape)
    qdd, after = lab.mujoco_forward(model, now, share * simulate.limits(model)[1])
    off = np.abs(now.qd + model.opt.timestep * qdd - after).max()
    assert f"(With $M$ alone the prediction is off by {off:.3f} rad/s;" in SENTENCES


def test_a_torque_that_is_held_brakes_the_pushed_arm_as_well(arm, monkeypatch):
    model = panda.load("panda_nohand", drive="torque")
    ends = []
    for rate in (50.0, 500.0):
        monkeypatch.setattr(lab, "RATE", rate)
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        ends.append(f"{np.linalg.norm(path[-1] - path[-2]) * rate:.3f}")
    says = "with `RATE = 500.0` the hand still does {1} m/s instead of {0}."
    assert says.format(*ends) in SENTENCES


def test_half_the_damping_leaves_four_times_the_speed_as_the_guide_answers(arm):
    for share, says in ((0.5, "0.169 m/s, four times"), (0.25, "damping 0.229 m/s")):
        model = panda.load("panda_nohand", drive="torque")
        model.dof_damping[:] *= share
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        speed = np.linalg.norm(path[-1] - path[-2]) * lab.RATE
        assert f"{speed:.3f}" in says
        assert says in SENTENCES


@pytest.fixture(scope="module")
def lyapunov():
    """Return the guide's: V at first, its largest rise in a step, V at last."""
    code = re.search(r"```python\n(def lyapunov.*?)\nfor k", GUIDE, re.S)[1]
    model = panda.load("panda_nohand", drive="torque")
    space = {**vars(lab), "model": model, "arm": panda.arm(model)}
    exec(code, space)
    return space["lyapunov"]


def test_with_dampers_and_gravity_compensation_V_falls_in_every_step(lyapunov):
    first, rise, last = lyapunov(100, 20, 1)
    assert rise < 0.0
    assert f"from {first:.1f} J to less than 0.000001 J" in SENTENCES
    assert 0.0 < last < 1e-6
    _, rise, last = lyapunov(100, 5, 1)
    assert rise < 0.0
    assert f"and to {last:.3f} J with a quarter of the damper" in SENTENCES
    assert lyapunov(100, 0, 1)[1] < 0.0  # by the joints' own damping
    assert "With $d_c = 0$ it still falls" in SENTENCES


def test_without_its_causes_V_rises(lyapunov):
    _, rise, last = lyapunov(100, 20, 0)
    assert rise > 1e-3
    assert f"ends at {last:.2f} J" in SENTENCES
    assert lyapunov(100, -3, 1)[1] > 1.0


def test_the_power_of_the_dampers_is_what_V_loses_only_with_the_rate_of_M(arm):
    """At random states of a motion under the law, by differences of V along it."""
    rng = np.random.default_rng(47)
    h = 1e-6
    without = []
    for q in verify.random_q(panda.load("panda_nohand"), 20, seed=7):
        qd = rng.uniform(-2, 2, 7)
        now = arm.at(q)
        e = panda.READY_Q - q
        tau = 100 * e - 20 * qd + now.gravity_torque
        qdd = np.linalg.solve(now.M, tau - now.bias(qd) - arm.damping * qd)
        Mdot = (arm.at(q + h * qd).M - arm.at(q - h * qd).M) / (2 * h)
        fixed = qd @ now.M @ qdd - 100 * e @ qd
        dampers = -(20 + arm.damping) * qd @ qd
        assert abs(fixed + 0.5 * qd @ Mdot @ qd - dampers) < 1e-6 * abs(dampers)
        without.append(abs(fixed - dampers))
    assert np.median(without) > 0.1  # watts


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
        (held[0], f"turns the other way: {held[0]:.2f} N m"),
        (M[0, 0], f"- {M[0, 0]:.0f} kg m²: with"),
        (faster[0], f"- {faster[0]:.2f} N m: it accelerates downwards"),
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
    assert f"With $M$ alone the prediction is off by {off(0.0):.3f} rad/s" in SENTENCES
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
    assert "fits the equation less well" in SENTENCES


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


# -- errata ---------------------------------------------------------------------------


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


def test_the_script_runs_as_a_person_runs_it(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["day4_dynamics.py", "--no-log"])
    monkeypatch.setattr(lab, "TRIALS", 10)
    monkeypatch.setattr(lab, "LIBRARY_TRIALS", 10)
    assert lab.main() == 0
    out = capsys.readouterr().out
    assert "All checks PASSED." in out
    assert max(map(len, out.splitlines())) <= 80


def test_the_heat_map_shows_every_entry_of_M_and_its_sign(arm):
    pytest.importorskip("viser")
    heat_map = find_day(4).module("inspector").heat_map
    M = arm.at(panda.READY_Q).M
    shown = [float(x) for x in re.findall(r">([-\d.]+)</td>", heat_map(M))]
    assert_same(np.reshape(shown, (7, 7)), M, 0.0051)


def forces(functions):
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return find_day(4).module("inspector").Forces(page)


def fallen(tab, seconds=1.0):
    """Return how far the hand is from where it was after a while of floating."""
    tab.press("float")
    for _ in range(round(25 * seconds)):
        tab.advance(1.0)
    hand = [tab.rig.at(q).T_world_ee[:3, 3] for q in (panda.READY_Q, tab.data.qpos)]
    return np.linalg.norm(hand[1] - hand[0])


def test_the_tab_floats_on_ones_own_torque_and_falls_with_a_wrong_sign():
    tab = forces(vars(lab))
    assert fallen(tab) < 1e-3
    assert tab.own.says()[1] == "good"
    tab.on_move(panda.READY_Q)
    assert_same(*tab.bars.show.call_args.args, 1e-9)  # the bars and the marks
    negative = {"gravity_torque": lambda *args: -lab.gravity_torque(*args)}
    tab = forces({**vars(lab), **negative})
    assert fallen(tab) > 0.3
    says, kind = tab.own.says()
    assert (kind, "gravity_torque by" in says) == ("bad", True)

"""Day 8: the numbers in the guide's sentences, every reason in it, and the tab."""

import copy
import importlib.util
import io
import re
from contextlib import redirect_stdout
from unittest.mock import MagicMock, patch

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need
from labkit.judge.row import rows_of
from labkit.lesson.day import find_day
from robo47 import identification, panda, verify

DAY = find_day(8)
GUIDE = (ROOT / "w2-autonomy/docs/day8-lab.md").read_text("utf-8")
OWN = re.sub(r"<!-- run.*?<!-- end -->", "", GUIDE, flags=re.S)
SENTENCES = " ".join(OWN.replace("*", "").split())
day8_mujoco = load_script(ROOT / "w2-autonomy/src/day8_mujoco.py")
lab = load_script(ROOT / "w2-autonomy/src/day8_identification.py")
LOAD = np.append(lab.LOAD, lab.LOAD * lab.AT)
model = panda.load("panda_nohand", drive="torque")
hung = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(lab.LOAD, lab.AT))
arm = panda.arm(model)
robot = day8_mujoco.changed(model, lab.SEED)


@pytest.fixture(scope="module")
def data():
    """Return Y, exact torques and the fast rows of three motions."""
    motions = {
        "swing": day8_mujoco.swing(),
        "excited": day8_mujoco.excitation(model, lab.SEED),
        "elsewhere": day8_mujoco.anywhere(model, lab.SEED, lab.TRIALS),
    }
    return {
        name: (lab.regressor(arm, m), day8_mujoco.torques(robot, m), np.abs(m.qd) > lab.SLOW)
        for name, m in motions.items()
    }


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints, 80 columns wide at most."""
    told = {"how many of 70 numbers show: links": "43",
            "grams off, of 500: one from either side": "43"}  # fmt: skip
    with (
        patch("sys.argv", ["lab", "--no-log"]),
        patch("labkit.lesson.lab.predictions", lambda worksheet: told),
        redirect_stdout(io.StringIO()) as out,
    ):
        assert lab.main() == 0
    assert all(len(line) <= 80 for line in out.getvalue().splitlines())
    return out.getvalue()


def fitted(data, name, noise, rtol=lab.RTOL, known=0.0):
    """Return the residual of a fit and its error elsewhere, RMS."""
    Y, tau, fast = data[name]
    Y_new, truth, new = data["elsewhere"]
    Y = Y[fast]
    tau = (tau + noise)[fast]
    phi = known + identification.fit(Y, tau - Y @ (known + np.zeros(91)), rtol)
    return lab.rms(tau - Y @ phi), lab.rms((Y_new @ phi - truth)[new])


def noises(seed):
    """Return the lab's noise of both motions, with another seed."""
    return lab.NOISE * np.random.default_rng(seed).normal(size=(2, 200, 7))


def test_what_the_arm_hides(data):
    Y = data["elsewhere"][0]
    flat = Y.reshape(-1, 91)
    rank = lambda A: identification.identifiable(A, 1e-9)[0]  # noqa: E731
    assert rank(flat[:, :70]) == 1 + 6 * 7 == 43
    assert rank(flat) == 43 + 21 - 2 == 62
    zero = np.flatnonzero(np.abs(flat).max(axis=0) < 1e-12)
    assert zero.tolist() == [0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 13]
    assert f"{len(zero)} of the 70 columns are zero" in SENTENCES
    hidden = np.abs(np.linalg.svd(flat)[2][62:]).max(axis=0) > 1e-9
    assert hidden[:70:10].all()  # no link's mass
    assert hidden[70:].nonzero()[0].tolist() == [0, 1]  # two rotors, and no friction
    assert [rank(Y[:k].reshape(-1, 91)) for k in (8, 9)] == [56, 62]
    assert "Nine states at random, 63 rows" in SENTENCES
    tipped = copy.copy(model)  # joint1 upright no more: two of m c show as well
    tipped.opt.gravity[:] = [1.0, 0.3, -9.7]
    Y = lab.regressor(panda.arm(tipped), day8_mujoco.anywhere(tipped, lab.SEED, 20))
    assert rank(Y.reshape(-1, 91)[:, :70]) == 45


def test_without_a_cut_the_rank_is_near_91_and_parameters_are_huge(data):
    Y, tau, fast = data["excited"]
    tau = tau + noises(lab.SEED)[1]
    for rtol, huge in ((lab.RTOL, False), (0.0, True)):
        assert (lab.identifiable(Y[fast], rtol)[0] >= 89) == huge
        assert (np.abs(lab.fit(Y[fast], tau[fast], rtol)).max() > 1e11) == huge
    assert "a rank near 91, and parameters of 1e12 | nothing was cut" in SENTENCES


def test_two_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day8.md").read_text("utf-8")
    assert "you predicted 43, measured 43: how many of 70 numbers show" in printed
    assert "you predicted 43, measured 43.25: grams off, of 500: one" in printed
    for row in ("how many of 70 numbers show: links", "grams off, of 500: one from"):
        assert f"| {row}" in sheet


def test_one_hinge_feels_three_of_ten():
    A = [[0, a, 0, a, 0, 9.81] for a in (-1, 1, 2)]
    row = identification.link_regressor([0, 2.0, 0, 0, 0, 0], A)[:, 1]
    assert np.flatnonzero(np.abs(row).max(axis=0)).tolist() == [1, 3, 5]
    assert "feel at all? (Three." in SENTENCES


def test_without_noise_torques_are_right_and_masses_wrong(data):
    Y, tau, fast = data["excited"]
    phi = identification.fit(Y[fast], tau[fast], lab.RTOL)
    Y_new, truth, new = data["elsewhere"]
    assert np.abs((Y_new @ phi - truth)[new]).max() < 1e-12
    dof = np.concatenate([robot.dof_damping, robot.dof_frictionloss])
    assert_same(phi[77:], dof, 1e-13)
    true = robot.body_mass[[model.body(f"link{i}").id for i in range(1, 8)]]
    for masses in (phi[:70:10], true):
        words = ", ".join("0" if abs(m) < 1e-9 else f"{m:.2f}" for m in masses)
        assert f"({words})" in SENTENCES
    assert max(fitted(data, name, 0.0)[0] for name in ("swing", "excited")) < 1e-12


def test_the_smaller_residual_is_luck_and_says_nothing_of_elsewhere(data):
    smaller = 0
    for seed in range(1, 9):
        swing, excited = noises(seed)
        one, other = fitted(data, "swing", swing), fitted(data, "excited", excited)
        smaller += one[0] < other[0]
        assert 0.09 < min(one[0], other[0]) <= max(one[0], other[0]) < 0.11
        assert other[1] < 0.2 < 15_000 < one[1]
    assert f"In {smaller} of 8 the swing's is the smaller one" in SENTENCES


def test_the_trap_of_the_lab_and_what_tells(data, printed):
    numbers = r"^  .{20} +\d+ +([\d,]+) +([\d.]+) +([\d,.]+) +([\d,.]+) +\d+%$"
    rows = re.findall(numbers, printed.replace(",", ""), re.M)
    swing, cut, _, slow, excited = np.array(rows, dtype=float)
    assert swing[0] == pytest.approx(1e8, rel=0.05)
    assert f"{swing[1]:.4f} for {excited[1]:.4f}" in SENTENCES
    assert f"of two fits be {swing[2]:,.0f} N m wrong" in SENTENCES
    assert f"sigma, which says {swing[3]:,.0f}" in SENTENCES
    assert f"it is {cut[2]:.1f} N m off" in SENTENCES
    assert f"Sigma says {cut[3]:.1f}" in SENTENCES
    assert (
        f"half as large again, {slow[2]:.3f} instead of {excited[2]:.3f}" in SENTENCES
    )
    noise = noises(lab.SEED)[0]
    known = day8_mujoco.numbers(arm)
    near = fitted(data, "swing", noise, 1e-2, known)[1]
    assert f"as the file has it: {near:.2f} N m" in SENTENCES
    fast = data["excited"][2][::20]
    assert f"samples are {fast.sum()} rows for 62 numbers" in SENTENCES


def test_dry_friction_spoils_the_rows_that_the_guide_says(data):
    Y, tau, fast = data["excited"]
    phi = identification.fit(Y[fast], tau[fast], lab.RTOL)
    motion = day8_mujoco.excitation(model, lab.SEED)
    bad = np.abs(Y @ phi - tau) > 0.01
    turned = motion.qd + motion.qdd * (0.95 * 0.02 / 2.0)
    assert (bad == (np.sign(turned) != np.sign(motion.qd))).all()
    assert f"{(~fast).sum()} of 1,400 have a speed below 0.1" in SENTENCES
    assert f"exactly the {bad.sum()} where" in SENTENCES
    assert f"none is faster than {np.abs(motion.qd)[bad].max():.3f} rad/s" in SENTENCES
    phi = identification.fit(Y.reshape(-1, 91), tau.ravel(), lab.RTOL)
    assert f"they cost {np.abs(Y @ phi - tau).max():.2f} N m at worst" in SENTENCES


def costs(code, motion):
    """Return the largest wrong torque of an arm_regressor at some states, N m."""
    off = []
    for q, qd, qdd in zip(*motion, strict=True):
        now = arm.at(q)
        given = now.J_space, now.T_links, qd, qdd, arm.gravity
        off.append(code(*given) - identification.arm_regressor(*given))
    return np.abs(off @ day8_mujoco.numbers(arm)[:70]).max()


def test_what_mistakes_cost_in_motion_and_at_rest():
    still = np.zeros((1, 7))
    at_rest = day8_mujoco.Motion(panda.READY_Q[None], still, still)
    motions = day8_mujoco.anywhere(model, lab.SEED, 20), at_rest
    ways = {way.slug: way.code for way in rows_of(DAY)["arm_regressor"].named}
    cost = {slug: [costs(code, m) for m in motions] for slug, code in ways.items()}
    rows = re.findall(r"^\| ([a-z-]+) \| ([\d.]+) \| ([\d.]+) \|$", GUIDE, re.M)
    assert len(rows) == 6
    for slug, *written in rows:
        for value, words in zip(cost[slug], written, strict=True):
            assert f"{value:.{len(words.partition('.')[2])}f}" == words
    unseen = sum(rest < 1e-9 < moving for moving, rest in cost.values())
    assert f"shows nothing of {unseen} of the {len(cost)} mistakes" in SENTENCES


@pytest.mark.kit
def test_other_robots_are_weighed_as_well_and_friction_is_why_not():
    def grams(q, extra):
        given = *day8_mujoco.hands(arm, q), extra, arm.gravity
        return 1000 * identification.payload_from_holds(*given)[0]

    both, crossed = [], []
    poses = panda.READY_Q + np.random.default_rng(lab.SEED).uniform(-0.5, 0.5, (5, 7))
    for seed in range(1, 9):
        robots = (day8_mujoco.changed(one, seed) for one in (model, hung))
        (_, empty), (q, full) = (day8_mujoco.holds(one, arm, poses) for one in robots)
        both.append(grams(q.mean(axis=0), (full - empty).mean(axis=0)))
        crossed += [grams(q[i], full[i] - empty[1 - i]) for i in (0, 1)]
    assert f"is {np.abs(np.array(both) - 500).max():.1f} g off at worst" in SENTENCES
    assert f"finds {min(crossed):.0f} to {max(crossed):.0f} g" in SENTENCES


def test_poses_that_turn_about_gravity_hide_a_part_of_the_centre():
    q = np.array([panda.READY_Q] * 5)
    q[:, 0] = np.linspace(-1, 1, 5)
    extra = verify.mujoco_bias(hung, q, 0 * q) - verify.mujoco_bias(model, q, 0 * q)
    rows = identification.load_regressor(*day8_mujoco.hands(arm, q), arm.gravity)
    assert [np.linalg.matrix_rank(r) for r in (rows[0], rows.reshape(-1, 4))] == [3, 3]
    m, *h = identification.payload_from_holds(*day8_mujoco.hands(arm, q), extra, arm.gravity)
    assert_same(1000 * np.array(h) / m, [20, -30, 0], 1e-9)
    assert "comes out as (20, -30, 0) mm" in SENTENCES


def test_the_lab_says_what_the_guide_says_of_weighing_and_floating(printed):
    grams = re.findall(r"([\d.]+) g at +(\S+) +(\S+) +(\S+) mm +(\S+) mm", printed)
    untold, one, crossed, both = np.array(grams, dtype=float)
    assert f"{crossed[0] - 500:.0f} g, and the centre is" in SENTENCES
    away = np.linalg.norm(crossed[1:4] - 1000 * lab.AT)
    assert f"the centre is {away:.0f} mm off" in SENTENCES
    assert f"sinks by {-untold[4]:.0f} mm" in SENTENCES
    assert f"the {crossed[0]:.0f} g, it rises by {crossed[4]:.0f}" in SENTENCES
    assert f"the {one[0]:.1f} g are {one[0] - 500:.1f} g wrong" in SENTENCES
    assert abs(one[4]) < abs(both[4])  # "float better than 500.0"
    loaded = day8_mujoco.changed(hung, lab.SEED)
    rest = np.zeros(7)
    phi = day8_mujoco.numbers(panda.arm(robot))[:70]  # no error of a fit to cancel

    def still(now):
        given = now.J_space, now.T_links, rest, rest, arm.gravity
        return lab.arm_regressor(*given) @ phi

    for row in (one, both):
        load = row[0] / 1000 * np.append(1.0, row[1:4] / 1000)
        row[4] = day8_mujoco.rises(loaded, arm, still, load)
    assert abs(both[4]) < 0.3 * abs(one[4])
    least = re.search(r"links found: (\S+)", printed)[1]
    assert f"It is {least}: there is no such arm" in SENTENCES


def test_what_no_torque_shows_is_why_there_is_no_such_arm(data):
    Y, tau, fast = data["excited"]
    Y = Y[fast]
    tau = (tau + noises(lab.SEED)[1])[fast]
    phi = lab.fit(Y, tau, lab.RTOL)
    true = day8_mujoco.numbers(panda.arm(robot))
    hidden = np.linalg.svd(Y, full_matrices=False)[2][62:]
    other = phi + hidden.T @ (hidden @ (true - phi))  # that part from the truth
    assert_same(Y @ other, Y @ phi, 1e-11)
    least = [min(map(lab.least_pseudo, p[:70].reshape(7, 10))) for p in (phi, other)]
    assert least[0] < -1.0 < -0.01 < least[1]
    assert "what is wrong is what no torque shows" in SENTENCES


def test_mujoco_refuses_what_no_body_can_have():
    body = (
        '<mujoco><worldbody><body><inertial pos="0 0 0" mass="1" diaginertia="{}"/>'
        "</body></worldbody></mujoco>"
    )
    mujoco.MjModel.from_xml_string(body.format("1 1 2"))
    with pytest.raises(ValueError, match="inertia"):
        mujoco.MjModel.from_xml_string(body.format("1 1 3"))


def test_second_differences_of_an_encoder_are_off_as_predicted():
    dt = 0.002
    step = 2.0 * np.pi / 2**16
    motion = day8_mujoco.excitation(model, lab.SEED, 5000)
    q = np.round(motion.q / step) * step
    off = (q[2:] - 2 * q[1:-1] + q[:-2]) / dt**2 - motion.qdd[1:-1]
    assert lab.rms(off) == pytest.approx(np.sqrt(0.5) * step / dt**2, rel=0.01)
    assert f"off by {lab.rms(off):.1f} rad/s²" in SENTENCES
    assert lab.rms(off) / np.abs(motion.qdd).max() == pytest.approx(3.0, abs=0.2)


def test_the_tab_weighs_and_shows_what_has_no_sigma():
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    inspector = DAY.module("inspector")
    tab = inspector.Weigh(MagicMock(q=panda.READY_Q.copy()))
    assert "Not held yet" in tab.table.content
    tab.press(inspector.HERE)
    assert "3 of 4 numbers show" in tab.table.content
    load, sigma = tab.weighed()["both, averaged"]
    assert abs(load[3]) < 0.001 < 0.02 < LOAD[3]  # far off, and says it is sure
    assert 1000 * sigma[3] / load[0] < 0.25
    tab.press(inspector.FIVE)
    good, sure = tab.weighed()["both, averaged"]
    _, unsure = tab.weighed()["one from either side"]
    assert_same(good, LOAD, 2e-3)
    assert sure[0] < 0.001 < 0.02 < unsure[0]
    tab.hang(1000)
    assert not tab.held

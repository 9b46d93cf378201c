"""Day 8: the numbers in the guide's sentences, every reason in it, and the tab."""

import copy
import re
from unittest.mock import patch

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import identification, panda, simulate
from robo47.errors import Robo47Error

import day8_mujoco

SENTENCES = sentences(8)
lab = load_script(ROOT / "w2-autonomy/src/day8_identification.py")
model = panda.load("panda_nohand", drive="torque")
arm = panda.arm(model)
robot = day8_mujoco.changed(model, lab.ROBOT_SEED)


@pytest.fixture(scope="module")
def data():
    """Return Y, exact torques and the fast rows of three motions."""
    motions = {
        "swing": day8_mujoco.swing(),
        "excited": day8_mujoco.excitation(model, lab.ROBOT_SEED),
        "elsewhere": day8_mujoco.anywhere(model, lab.ROBOT_SEED, lab.TRIALS),
    }
    return {
        name: (
            lab.regressor(arm, m),
            lab.mujoco_torques(robot, m),
            np.abs(m.qd) > lab.SLOW,
        )
        for name, m in motions.items()
    }


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"how many of 70 numbers show: links": "43",
            "sigma of the load, g: each from both sides": "20"}  # fmt: skip
    return printed_by(lab, told)


def fitted(data, name, noise, rtol=lab.RTOL, known=0.0):
    """Return the residual of a fit and its error elsewhere, RMS."""
    Y, tau, fast = data[name]
    Y_new, truth, new = data["elsewhere"]
    Y = Y[fast]
    tau = (tau + noise)[fast]
    phi = known + identification.truncated_svd_fit(
        Y, tau - Y @ (known + np.zeros(91)), rtol
    )
    return lab.rms(tau - Y @ phi), lab.rms((Y_new @ phi - truth)[new])


def noises(seed):
    """Return the lab's noise of both motions, with another seed."""
    return lab.NOISE * np.random.default_rng(seed).normal(size=(2, 200, 7))


def test_what_the_arm_hides(data):
    Y = data["elsewhere"][0]
    flat = Y.reshape(-1, 91)
    rank = lambda A: identification.rank_and_condition(A, 1e-9)[0]  # noqa: E731
    assert rank(flat[:, :70]) == 1 + 6 * 7 == 43
    assert rank(flat) == 43 + 21 - 2 == 62
    zero = np.flatnonzero(np.abs(flat).max(axis=0) < 1e-12)
    assert zero.tolist() == [0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 13]
    assert f"{len(zero)} of the 70 columns are zero" in SENTENCES
    hidden = np.abs(np.linalg.svd(flat)[2][62:]).max(axis=0) > 1e-9
    assert hidden[:70:10].all()  # no link's mass
    assert hidden[70:].nonzero()[0].tolist() == [0, 1]  # two rotors, and no friction
    assert [rank(Y[:k].reshape(-1, 91)) for k in (8, 9)] == [56, 62]
    assert "Nine random states (63 rows)" in SENTENCES
    tipped = copy.copy(model)  # joint1 upright no more: two of m c show as well
    tipped.opt.gravity[:] = [1.0, 0.3, -9.7]
    Y = lab.regressor(
        panda.arm(tipped), day8_mujoco.anywhere(tipped, lab.ROBOT_SEED, 20)
    )
    assert rank(Y.reshape(-1, 91)[:, :70]) == 45


def test_without_a_cut_the_rank_is_near_91_and_parameters_are_huge(data):
    Y, tau, fast = data["excited"]
    tau = tau + noises(lab.ROBOT_SEED)[1]
    for rtol, huge in ((lab.RTOL, False), (0.0, True)):
        assert (lab.rank_and_condition(Y[fast], rtol)[0] >= 89) == huge
        assert (
            np.abs(lab.truncated_svd_fit(Y[fast], tau[fast], rtol)).max() > 1e11
        ) == huge
    assert "a rank near 91, and parameters of 1e12 | nothing was truncated" in SENTENCES


@pytest.mark.kit
def test_two_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day8.md").read_text("utf-8")
    assert "you predicted 43, measured 43: how many of 70 numbers show" in printed
    assert "you predicted 20, measured 15.7" in printed
    for row in ("how many of 70 numbers show: links", "sigma of the load, g: each"):
        assert f"| {row}" in sheet


def test_without_noise_torques_are_right_and_masses_wrong(data):
    Y, tau, fast = data["excited"]
    phi = identification.truncated_svd_fit(Y[fast], tau[fast], lab.RTOL)
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
    assert f"In {smaller} of 8 runs the swing has the smaller residual" in SENTENCES


@pytest.mark.kit
def test_the_fit_that_fools_is_wrong_without_noise_too_and_by_what_it_cut(
    data, printed
):
    row = r"truncated, in m +44 +883 +[\d.]+ +[\d.]+ +([\d.]+) +(\d+)%"
    sigma, inside = re.search(row, printed).groups()
    off = fitted(data, "swing", noises(lab.NOISE_SEED)[0], lab.CUT)[1]
    assert f"on new motions its error is {off:.1f} N m" in SENTENCES
    assert (
        f"sigma = {float(sigma):.1f} N m, but its error is {off:.1f} N m" in SENTENCES
    )
    assert f"only {inside} %" in SENTENCES
    exact = fitted(data, "swing", 0.0, lab.CUT)[1]
    assert f"Without any noise the error is still {exact:.1f} N m" in SENTENCES
    fast = data["excited"][2][::20]
    assert f"are {fast.sum()} equations for 62 base parameters" in SENTENCES


def test_the_unit_of_length_moves_a_fit_that_was_cut_and_no_other(data):
    Y, tau, fast = data["swing"]
    Y_new, truth, new = data["elsewhere"]
    tau = (tau + noises(lab.NOISE_SEED)[0])[fast]
    off = []
    for per_metre in (1.0, 10.0, 100.0):
        unit = lab.lengths(per_metre)
        phi = identification.truncated_svd_fit(Y[fast] / unit, tau, lab.CUT)
        off.append(lab.rms((Y_new / unit @ phi - truth)[new]))
    words = "{:.2f} N m in metres, {:.2f} in decimetres and {:.2f} in centimetres"
    assert words.format(*off) in SENTENCES
    Y, tau, fast = data["excited"]
    seen = [
        lab.rank_and_condition(Y[fast] / lab.lengths(u), 1e-9)[1] for u in (1, 10, 100)
    ]
    words = "is {:.0f} in metres, 1,290 in decimetres and 119,000 in centimetres"
    assert words.format(seen[0]) in SENTENCES
    assert seen[1:] == pytest.approx([1290, 119_000], rel=0.01)


def test_rows_of_the_same_motion_do_not_tell_which_cut_is_wrong_elsewhere(data):
    Y, tau, fast = data["swing"]
    known = day8_mujoco.numbers(arm)
    noise = noises(lab.NOISE_SEED)[0]
    Y, tau = Y[fast], (tau + noise)[fast] - Y[fast] @ known
    near = [cross_validated(Y, tau, cut) for cut in (1e-2, 1e-3, 1e-4)]
    far = [fitted(data, "swing", noise, cut, known)[1] for cut in (1e-2, 1e-3, 1e-4)]
    assert near[2] < near[0] < 2 * near[2] < far[0] < far[1] < far[2]


def swing_of(seed, data):
    """Return Y, tau minus the file's torque and the test data of another robot."""
    secret = day8_mujoco.changed(model, seed)
    known = day8_mujoco.numbers(arm)
    Y, _, fast = data["swing"]
    Y_new, _, new = data["elsewhere"]
    states = day8_mujoco.anywhere(model, lab.ROBOT_SEED, lab.TRIALS)
    tau = lab.mujoco_torques(secret, day8_mujoco.swing()) + noises(seed)[0]
    truth = lab.mujoco_torques(secret, states)[new]
    return Y[fast], tau[fast] - Y[fast] @ known, Y_new[new], truth - Y_new[new] @ known


@pytest.mark.kit
def test_twelve_robots_agree_on_the_difference_the_scales_and_cross_validation(data):
    of_a_link = np.repeat([0.4, 0.03, 0.02], [1, 3, 6])
    size = np.append(np.tile(of_a_link, 7), [0.5] * 21)
    cuts = (1e-2, 1e-3, 1e-4)
    plain, scaled, left_out = [], [], []
    for seed in range(1, 13):
        Y, tau, Y_new, truth = swing_of(seed, data)
        fit = identification.truncated_svd_fit
        plain.append([lab.rms(Y_new @ fit(Y, tau, cut) - truth) for cut in cuts])
        scaled.append([
            lab.rms(Y_new @ (size * fit(Y * size, tau, cut)) - truth)
            for cut in cuts[:2]
        ])  # fmt: skip
        left_out.append([cross_validated(Y, tau, cut) for cut in cuts])
    ends = np.array([np.min(plain, axis=0), np.max(plain, axis=0)]).T
    words = (
        "then {:.2f} to {:.2f} N m with rtol = 1e-2. With 1e-3 it is {:.2f} to {:.2f} "
        "N m, and with 1e-4 it is {:.0f} to {:.0f} N m"
    )
    assert words.format(*ends.ravel()) in SENTENCES
    assert (np.argmin(left_out, axis=1) > 0).all()
    assert "selects 1e-2 for none of the twelve robots" in SENTENCES
    ends = np.array([np.min(scaled, axis=0), np.max(scaled, axis=0)]).T
    words = (
        "robots the test error is {:.2f} to {:.2f} N m with 1e-2, "
        "and {:.2f} to {:.2f} N m with 1e-3"
    )
    assert words.format(*ends.ravel()) in SENTENCES


def cross_validated(Y, tau, cut):
    """Return the error of five fits to four fifths of the rows, at the others."""
    fifths = np.array_split(np.random.default_rng(0).permutation(len(tau)), 5)
    off = []
    for out in fifths:
        rest = np.setdiff1d(np.arange(len(tau)), out)
        off.append(
            Y[out] @ identification.truncated_svd_fit(Y[rest], tau[rest], cut)
            - tau[out]
        )
    return lab.rms(np.concatenate(off))


def test_numbers_in_the_sizes_that_one_expects_have_no_unit_of_length(data):
    Y, tau, fast = data["swing"]
    Y_new, truth, new = data["elsewhere"]
    known = day8_mujoco.numbers(arm)
    tau = (tau + noises(lab.NOISE_SEED)[0])[fast] - Y[fast] @ known
    of_a_link = np.repeat([0.4, 0.03, 0.02], [1, 3, 6])
    size = np.append(np.tile(of_a_link, 7), [0.5] * 21)
    off = []
    for per_metre in (1.0, 100.0):
        unit = lab.lengths(per_metre)
        for cut in (1e-2, 1e-3):
            phi = identification.truncated_svd_fit(
                Y[fast] / unit * (size * unit), tau, cut
            )
            phi *= size
            off.append(lab.rms((Y_new @ (known + phi) - truth)[new]))
    assert off[:2] == pytest.approx(off[2:], rel=1e-6)
    assert "the same in metres and in centimetres" in SENTENCES
    divided = identification.truncated_svd_fit(Y[fast] / size, tau, 1e-2) / size
    assert lab.rms((Y_new @ (known + divided) - truth)[new]) > 3 * off[0]


@pytest.mark.kit
def test_one_frequency_and_a_small_reach_are_why_the_swing_shows_little():
    t = np.arange(200) * 0.05
    w = np.pi
    v = 2.37 * w
    reach = day8_mujoco.REACH
    seen = []
    for share, wide in ((0.0, 1.0), (0.05, 1.0), (0.0, 2.0)):
        along = (1 - np.cos(w * t)) / 2 + share * np.sin(v * t)
        fast = w * np.sin(w * t) / 2 + share * v * np.cos(v * t)
        up = w * w * np.cos(w * t) / 2 - share * v * v * np.sin(v * t)
        q, qd, qdd = (np.outer(x, wide * reach) for x in (along, fast, up))
        motion = day8_mujoco.Motion(panda.READY_Q + q, qd, qdd)
        Y = lab.regressor(arm, motion)[np.abs(qd) > lab.SLOW]
        seen.append(lab.rank_and_condition(Y, 1e-9)[1])
    assert seen[0] == pytest.approx(102e6, rel=0.01)  # all joints by one function, and
    assert seen[1] == pytest.approx(17_200, rel=0.01)  # so here: two frequencies
    assert seen[2] < 1e6  # or twice the reach
    assert "falls from 102,000,000 to 17,200" in SENTENCES
    one = [lab.rank_and_condition(lab.pendulum(r, 0.0), 1e-9)[1] for r in (0.1, 0.3)]
    assert one[0] / one[1] == pytest.approx(27, rel=0.02)  # the reach cubed


@pytest.mark.kit
def test_a_second_sine_and_own_beginnings_bring_the_condition_down():
    def condition(far, begin):
        motion = day8_mujoco.harmonics(robot, lab.OFTEN, far, begin)
        with patch.object(lab, "arm_regressor", identification.arm_regressor):
            Y = lab.regressor(arm, motion)[np.abs(motion.qd) > lab.SLOW]
        return lab.rank_and_condition(Y, lab.RTOL)[1]

    assert condition(lab.FAR, lab.BEGIN) == pytest.approx(83e6, rel=0.01)
    two = np.array([[0.3] * 7, [0.2] * 7])
    assert condition(two, lab.BEGIN) == pytest.approx(3400, rel=0.02)
    begins = [np.random.default_rng(seed).uniform(0, 2 * np.pi, (2, 7))
              for seed in range(12)]  # fmt: skip
    seen = [condition(two, begin) for begin in begins]
    assert f"it is {min(seen):.0f} to {max(seen):.0f} for twelve random" in SENTENCES
    begin = begins[0]
    with pytest.raises(Robo47Error, match="out of its range"):
        condition(10 * two, begin)


def test_dry_friction_spoils_the_rows_that_the_guide_says(data):
    Y, tau, fast = data["excited"]
    phi = identification.truncated_svd_fit(Y[fast], tau[fast], lab.RTOL)
    motion = day8_mujoco.excitation(model, lab.ROBOT_SEED)
    bad = np.abs(Y @ phi - tau) > 0.01
    turned = motion.qd + motion.qdd * (0.95 * 0.02 / 2.0)
    assert (bad == (np.sign(turned) != np.sign(motion.qd))).all()
    assert f"than 0.1 rad/s in {(~fast).sum()} of 1,400 rows" in SENTENCES
    assert f"exactly the {bad.sum()} rows where" in SENTENCES
    fastest = np.abs(motion.qd)[bad].max()
    assert f"all of them are slower than {fastest:.3f} rad/s" in SENTENCES
    phi = identification.truncated_svd_fit(Y.reshape(-1, 91), tau.ravel(), lab.RTOL)
    words = f"torque error without noise is {np.abs(Y @ phi - tau).max():.2f} N m"
    assert words in SENTENCES


def test_the_excitation_is_as_fast_as_the_joints_may_go_but_not_as_far():
    motion = day8_mujoco.excitation(model, lab.ROBOT_SEED, 2000)
    speed = np.abs(motion.qd).max(axis=0) / simulate.SPEED_LIMITS
    assert_same(speed, np.full(7, day8_mujoco.SPEED_SHARE), 1e-9)
    low, high = simulate.limits(model)[0].T
    reach = np.ptp(motion.q, axis=0) / (high - low)
    assert reach.max() < 0.7 < day8_mujoco.RANGE_SHARE
    words = f"for each joint, up to {day8_mujoco.SPEED_SHARE} of its velocity limit"
    assert words in SENTENCES


def test_normal_equations_are_singular_by_zero_columns_and_else_up_to_rounding(data):
    Y, tau, fast = data["excited"]
    Y = Y[fast]
    with pytest.raises(np.linalg.LinAlgError, match="Singular"):
        np.linalg.solve(Y.T @ Y, Y.T @ tau[fast])
    Y = Y[:, np.abs(Y).max(axis=0) > 1e-9]
    square = np.abs(np.linalg.eigvalsh(Y.T @ Y))  # one machine solves it, others raise
    assert (square < 1e-13 * square.max()).sum() == 18
    rank, _ = lab.rank_and_condition(Y, lab.RTOL)
    assert Y.shape[1] - rank == 18
    assert "and 18 more combinations are unidentifiable" in SENTENCES
    assert "NumPy does not raise this error every time" in SENTENCES


def test_to_drop_all_slow_rows_costs_little_beside_the_twenty_wrong_ones(data):
    Y, tau, fast = data["excited"]
    motion = day8_mujoco.excitation(model, lab.ROBOT_SEED)
    turned = np.sign(motion.qd + motion.qdd * (0.95 * 0.02 / 2.0))
    right = turned == np.sign(motion.qd)
    assert ((~fast).sum(), (~right).sum()) == (138, 20)
    other = Y.copy()
    joints = np.arange(7)
    other[:, joints, 84 + joints] = turned
    Y_new, truth, new = data["elsewhere"]
    ways = ((Y, fast), (Y, right), (other, fast | True))
    off = np.zeros((10, 3))
    for seed in range(10):
        measured = tau + noises(seed)[1]
        for k, (rows, kept) in enumerate(ways):
            phi = identification.truncated_svd_fit(rows[kept], measured[kept], lab.RTOL)
            off[seed, k] = lab.rms((Y_new @ phi - truth)[new])
    slow, twenty, column = off.mean(axis=0)
    assert max(twenty, column) < slow < 1.1 * min(twenty, column)
    words = "simplest to omit all slow rows, which costs little accuracy"
    assert words in SENTENCES


def test_what_no_torque_shows_is_why_there_is_no_such_arm(data):
    Y, tau, fast = data["excited"]
    Y = Y[fast]
    tau = (tau + noises(lab.ROBOT_SEED)[1])[fast]
    phi = lab.truncated_svd_fit(Y, tau, lab.RTOL)
    true = day8_mujoco.numbers(panda.arm(day8_mujoco.without_friction(robot)))
    hidden = np.linalg.svd(Y, full_matrices=False)[2][62:]
    other = phi + hidden.T @ (hidden @ (true - phi))  # that part from the truth
    assert_same(Y @ other, Y @ phi, 1e-11)
    least = [
        min(map(lab.min_pseudo_inertia_eig, p[:70].reshape(7, 10)))
        for p in (phi, other)
    ]
    assert least[0] < -1.0
    assert f"eigenvalue is {least[1]:.3f}. This remainder comes from noise" in SENTENCES
    phi = lab.truncated_svd_fit(Y, data["excited"][1][data["excited"][2]], lab.RTOL)
    other = phi + hidden.T @ (hidden @ (true - phi))
    assert min(map(lab.min_pseudo_inertia_eig, other[:70].reshape(7, 10))) > 0.0


def test_second_differences_of_an_encoder_are_off_as_predicted():
    dt = 0.002
    step = 2.0 * np.pi / 2**16
    motion = day8_mujoco.excitation(model, lab.ROBOT_SEED, 5000)
    q = np.round(motion.q / step) * step
    off = (q[2:] - 2 * q[1:-1] + q[:-2]) / dt**2 - motion.qdd[1:-1]
    assert lab.rms(off) == pytest.approx(np.sqrt(0.5) * step / dt**2, rel=0.01)
    assert f"its RMS error is {lab.rms(off):.1f} rad/s²" in SENTENCES
    assert lab.rms(off) / np.abs(motion.qdd).max() == pytest.approx(3.0, abs=0.2)


@pytest.mark.kit
def test_with_twelve_robots_the_truncated_swing_is_worse_than_the_model_file(data):
    swing, excited, elsewhere = (data[n][0] for n in ("swing", "excited", "elsewhere"))
    new = data["elsewhere"][2]
    moved = day8_mujoco.swing()
    known = day8_mujoco.numbers(arm)
    found = []
    for seed in range(1, 13):
        secret = day8_mujoco.changed(model, seed)
        exact = lab.mujoco_torques(secret, moved)
        truth = lab.mujoco_torques(
            secret, day8_mujoco.anywhere(model, lab.ROBOT_SEED, lab.TRIALS)
        )
        seen = {
            "swing": (swing, exact, data["swing"][2]),
            "elsewhere": (elsewhere, truth, new),
        }
        noise = noises(seed)[0]
        fast = data["swing"][2]
        unit = lab.lengths(100.0)
        phi = identification.truncated_svd_fit(
            swing[fast] / unit, (exact + noise)[fast], lab.CUT
        )
        found.append([
            fitted(seen, "swing", noise, lab.CUT)[1],
            lab.rms((elsewhere @ known - truth)[new]),
            lab.rms((elsewhere / unit @ phi - truth)[new]),
        ])  # fmt: skip
    off, file, centimetres = np.transpose(found)
    assert excited.shape == swing.shape
    assert f"In {(off > file).sum()} of 12 cases" in SENTENCES
    words = (
        "errors are {:.1f} to {:.1f} N m, and the errors of the file are "
        "{:.1f} to {:.1f}"
    )
    ends = off.min(), off.max(), file.min(), file.max()
    assert words.format(*ends) in SENTENCES
    better = (centimetres < file).sum()
    assert f"better than the model file for only {better} of 12 robots" in SENTENCES


def test_the_powers_of_the_amplitude_hold_for_small_swings_only():
    seen = {
        (A, second): lab.rank_and_condition(lab.pendulum(A, second), 1e-12)[1]
        for A in (0.1, 0.3, 1.0, 2.0)
        for second in (0.0, 0.2)
    }
    assert seen[0.1, 0.0] / seen[0.3, 0.0] == pytest.approx(27, rel=0.02)
    assert seen[0.1, 0.2] / seen[0.3, 0.2] == pytest.approx(3, rel=0.05)
    rises = f"from {seen[1.0, 0.2]:.1f} to {seen[2.0, 0.2]:.1f}"
    assert rises in SENTENCES


def test_the_largest_singular_values_belong_to_the_columns_of_size_one():
    Vt = np.linalg.svd(lab.pendulum(0.1, 0.0))[2]
    assert (np.sum(Vt[:2, [1, 4]] ** 2, axis=1) > 0.99).all()  # cos q and sign q'


@pytest.mark.kit
def test_any_second_frequency_helps_unless_position_determines_acceleration():
    t = np.arange(200) * 0.05
    w = np.pi

    def condition(ratio, phase):
        v = ratio * w
        swings = (
            (1 - np.cos(w * t)) / 2 + 0.05 * np.sin(v * t + phase),
            w * np.sin(w * t) / 2 + 0.05 * v * np.cos(v * t + phase),
            w * w * np.cos(w * t) / 2 - 0.05 * v * v * np.sin(v * t + phase),
        )
        q, qd, qdd = (np.outer(x, day8_mujoco.REACH) for x in swings)
        motion = day8_mujoco.Motion(panda.READY_Q + q, qd, qdd)
        Y = lab.regressor(arm, motion)[np.abs(qd) > lab.SLOW]
        return lab.rank_and_condition(Y, 1e-13)[1]

    ratios = (1.3, 1.5, 1.7, 1.9, 2, 2.1, 2.37, 2.7, 3, 3.5, 4.1)
    seen = {(r, p): condition(r, p) for r in ratios for p in (0.0, 0.8, np.pi / 2)}
    alike = {r: seen.pop((r, np.pi / 2)) for r in (2, 3)}
    assert alike == {
        2: pytest.approx(4.8e6, rel=0.02),
        3: pytest.approx(4.0e5, rel=0.02),
    }
    assert 9_000 < min(seen.values()) < max(seen.values()) < 120_000
    assert "they give 4,800,000 and 400,000" in SENTENCES
    out = np.linspace(0.0, 1.0, 201)  # s: the arm moves out, then back until 2 s
    for ratio in ratios:
        along, back = (
            (1 - np.cos(w * x)) / 2 + 0.05 * np.cos(ratio * w * x)
            for x in (out, 2.0 - out)
        )
        # One position on the path out and back: also one acceleration.
        same_path = np.allclose(along, back) and (np.diff(along) > 0).all()
        assert same_path == (ratio in alike)
    assert "The position then still determines the acceleration" in SENTENCES


def test_the_swing_goes_like_the_sixth_to_seventh_power_at_six_poses():
    motion = day8_mujoco.swing()
    fast = np.abs(motion.qd) > lab.SLOW
    away = motion.q - panda.READY_Q
    for seed in range(6):
        rng = np.random.default_rng(seed)
        pose = panda.READY_Q + (rng.uniform(-0.5, 0.5, 7) if seed else 0.0)
        one, two = (
            lab.rank_and_condition(
                lab.regressor(
                    arm,
                    day8_mujoco.Motion(pose + k * away, k * motion.qd, k * motion.qdd),
                )[fast],
                1e-13,
            )[1]
            for k in (1.0, 2.0)
        )
        assert 5.8 < np.log2(one / two) < 7.2

"""Day 9: the numbers in the guide's sentences, and every reason in it."""

import copy
import io
import re
from contextlib import redirect_stdout
from types import SimpleNamespace
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import dynamics, estimation, panda, simulate
from robo47.references import raised_cosine
from robo47.screws import skew

import day9_mujoco
from day9_mujoco import STAY, SWING

SENTENCES = sentences(9)
lab = load_script(ROOT / "w2-autonomy/src/day9_estimation.py")
model = panda.load("panda_nohand", drive="torque")
arm = panda.arm(model)
Q = panda.READY_Q


@pytest.fixture(scope="module")
def swing():
    """Return two seconds of the swing."""
    return day9_mujoco.moved(model, arm, SWING, 2.0)


@pytest.fixture(scope="module")
def held():
    """Return the arm that holds still and is pushed on its flange."""
    push = day9_mujoco.push(lab.FLANGE, lab.FORCE, lab.SINCE)
    return day9_mujoco.moved(model, arm, STAY, 0.8, push)


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints, 80 columns wide at most."""
    told = {"noise of a 16-bit difference, rad/s": "0.0196",
            "detection time of a 10 N push, ms": "4",
            "residual of joint 4, N m": "-4.7"}  # fmt: skip
    return printed_by(lab, told)


def largest(residual):
    """Return the largest residual, N m."""
    return float(np.abs(residual).max())


@pytest.mark.kit
def test_three_predictions_of_the_worksheet_are_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day9.md").read_text("utf-8")
    for row, said in {
        "noise of a 16-bit difference, rad/s": "measured 0.01955",
        "detection time of a 10 N push, ms": "measured 4",
        "residual of joint 4, N m": "measured -4.709",
    }.items():
        assert f"| {row} |" in sheet
        assert f"{said}: {row}" in " ".join(printed.split())


def test_a_difference_is_qvel_by_eulers_own_rule_and_not_by_rk4():
    off = {}
    for name in ("EULER", "IMPLICITFAST", "RK4"):
        other = copy.copy(model)
        other.opt.integrator = int(getattr(mujoco.mjtIntegrator, f"mjINT_{name}"))
        data = simulate.start(other, Q)
        now = simulate.run(other, data, lambda t, q, qd: np.zeros(7), 0.5, rate=500.0)
        off[name] = np.abs(np.diff(now.q, axis=0) / 0.002 - now.qd[1:]).max()
    assert max(off["EULER"], off["IMPLICITFAST"]) < 1e-12
    assert f"{off['RK4']:.2f}" == "0.40"
    assert "(RK4), the same difference is wrong by 0.40 rad/s" in SENTENCES


@pytest.mark.kit
def test_the_autocorrelation_of_the_rounding_error_is_why_12_bits_differ():
    """Five amplitudes change the cause; a coarse encoder can be better or worse."""
    step = 2 * np.pi / 2**12
    ratio, shared = [], []
    for amplitude in (0.25, 0.5, 1.0, 2.0, 4.0):
        reference = raised_cosine(Q, amplitude * day9_mujoco.REACH)
        run = day9_mujoco.moved(model, arm, reference, 2.0)
        reported = lab.encoder(run.q, 12)
        off = lab.speeds(reported)[1:] - run.qd[1:]
        ratio.append(lab.rms(off) / (step / np.sqrt(6) / lab.DT))
        errors = (reported - run.q).T
        shared.append(np.mean([estimation.lag1_autocorrelation(e) for e in errors]))
    assert np.allclose(ratio, np.sqrt(1 - np.array(shared)), atol=0.025)
    assert f"prediction is {100 * (1 / ratio[2] - 1):.0f} % too large" in SENTENCES


@pytest.mark.parametrize(
    ("rate", "omega", "dies", "grows"),
    [(500, 20, 0.030, 0.034), (250, 20, 0.028, 0.032), (500, 40, 0.014, 0.016),
     (250, 40, 0.012, 0.016)],
)  # fmt: skip
def test_a_held_torque_takes_half_a_period_of_the_margin(rate, omega, dies, grows):
    margin = estimation.delay_margin(omega**2, 2 * omega) - 0.5 / rate
    assert dies < margin < grows
    left = [
        day9_mujoco.left_over(model, arm, late, omega, rate) for late in (dies, grows)
    ]
    assert left[0] < 0.1 < 3 < left[1]
    if (rate, omega) == (250, 20):
        words = (
            f"{1000 * margin:.2f} ms. With a delay of 32 ms the error after 2 s is "
            f"{left[1]:.0f} times as large"
        )
        assert words in SENTENCES


def test_noise_and_lag_of_a_low_pass_are_those_of_the_guides_two_formulas(swing):
    qd = swing.qd[:, lab.JOINT]
    z = lab.encoder(swing.q, 16)[:, lab.JOINT]
    raw = estimation.backward_difference(z, lab.DT)
    sigma = 2 * np.pi / 2**16 / np.sqrt(12)
    qdd = lab.rms(np.gradient(qd, lab.DT)[lab.SETTLED :])
    for f in (10.0, 20.0, 50.0):
        alpha = 1 - np.exp(-2 * np.pi * f * lab.DT)
        noise = sigma / lab.DT * alpha * np.sqrt(2 / (2 - alpha))
        lag = (1 - alpha) / alpha * lab.DT * qdd
        smooth = estimation.low_pass(raw, lab.DT, f)
        late = estimation.low_pass(qd, lab.DT, f)
        assert lab.rms((smooth - late)[lab.SETTLED :]) == pytest.approx(noise, rel=0.08)
        assert lab.rms((late - qd)[lab.SETTLED :]) == pytest.approx(lag, rel=0.01)


def both_tests(z, accel_psd, R):
    """Return the mean NIS, the lag-1 autocorrelation, and whether both are allowed."""
    output = lab.track(z, accel_psd, R)
    nis, n = output["nis"].mean(), len(output["nis"])
    lag1 = estimation.lag1_autocorrelation(output["innovation"])
    low, high = estimation.nis_interval(n, 1)
    return nis, lag1, bool(low < nis < high and abs(lag1) < 1.96 / np.sqrt(n))


@pytest.mark.kit
def test_an_accel_psd_passes_both_tests_on_the_swing_of_every_joint(swing):
    """A cosine is not white noise, and yet a filter with white noise passes."""
    R = (2 * np.pi / 2**16) ** 2 / 12
    z = lab.encoder(swing.q, 16)
    nis, lag1, passes = both_tests(z[:, lab.JOINT], 0.018, R)
    assert passes
    words = f"both tests: the mean NIS is {nis:.3f} and $\\rho_1$ is {lag1:.3f}"
    assert words in SENTENCES
    n = len(z) - lab.SETTLED
    low, high = estimation.nis_interval(n, 1)
    assert f"For the {n} readings of the swing" in SENTENCES
    assert f"between {low:.3f} and {high:.3f}, and $\\rho_1$ within" in SENTENCES
    assert f"within {1.96 / np.sqrt(n):.3f} of 0. To search" in SENTENCES
    for joint, accel_psd in enumerate(
        (0.0255, 0.0185, 0.0277, 0.018, 0.035, 0.0255, 0.04)
    ):
        assert both_tests(z[:, joint], accel_psd, R)[2], joint
    with redirect_stdout(io.StringIO()):
        found = lab.tested("", z[:, lab.JOINT], swing.qd[:, lab.JOINT], 0.018, R)
    assert f"RMS error is {found['error']:.4f} rad/s" in SENTENCES
    assert f"{found['inside']:.1%} of".replace("%", " %") in SENTENCES


@pytest.mark.kit
def test_a_finer_encoder_shows_that_a_cosine_is_not_white_noise(swing):
    R = (2 * np.pi / 2**18) ** 2 / 12
    z = lab.encoder(swing.q, 18)[:, lab.JOINT]
    tried = {q: both_tests(z, q, R) for q in np.geomspace(0.001, 1, 61)}
    assert not any(passes for *_, passes in tried.values())
    assert "no $q_a$ passes both tests for joint 4" in SENTENCES


@pytest.mark.kit
def test_rounding_alone_does_not_make_a_correct_filter_fail():
    """Only the readings change: the acceleration is white, as the filter assumes."""
    step = 2 * np.pi / 2**16
    found = []
    for accel_psd in (0.01, 0.1, 0.5):
        for seed in range(1, 13):
            with patch.multiple(lab, WANDERS=accel_psd, NOISE=0.0):
                z, _ = lab.wandering(np.random.default_rng(seed))
            found.append(both_tests(np.round(z / step) * step, accel_psd, step**2 / 12))
    nis, lag1, _ = np.transpose(found)
    assert 0.94 < nis.min() < 1 < nis.max() < 1.06
    assert np.abs(lag1).max() < 0.06


def test_a_filter_of_0_01_is_better_than_any_low_pass_and_its_minimum_moves(swing):
    qd = swing.qd[:, lab.JOINT]
    cutoffs = np.geomspace(5, 200, 40)
    best, at = {}, {}
    for bits in (14, 16, 18):
        z = lab.encoder(swing.q, bits)[:, lab.JOINT]
        raw = estimation.backward_difference(z, lab.DT)
        smooth = [estimation.low_pass(raw, lab.DT, f) for f in cutoffs]
        error = [lab.rms((one - qd)[lab.SETTLED :]) for one in smooth]
        best[bits], at[bits] = min(error), cutoffs[np.argmin(error)]
    words = f"{at[14]:.0f}, {at[16]:.0f} and {at[18]:.0f} Hz for 14, 16 and 18 bits"
    assert words in SENTENCES
    z, R = lab.encoder(swing.q, 16)[:, lab.JOINT], (2 * np.pi / 2**16) ** 2 / 12
    error = [
        lab.rms(lab.track(z, q, R)["velocity"] - qd[lab.SETTLED :])
        for q in (0.001, 0.01, 0.1, 1.0)
    ]
    assert min(error) == error[1] < best[16]


def test_the_ratio_decides_the_autocorrelation_and_the_scale_decides_the_nis():
    z, qd = lab.wandering(np.random.default_rng(lab.SEED))
    rows = {}
    for a, b in ((1, 1), (10, 10), (0.1, 1), (1, 10), (0.01, 1), (0.1, 10)):
        with redirect_stdout(io.StringIO()):
            one = lab.tested("", z, qd, a * lab.WANDERS, b * lab.NOISE**2)
        rows[a, b] = one
        row = (
            f"| {a} | {b} | {one['error']:.4f} | {one['nis']:.3f} | {one['lag1']:.3f} |"
        )
        assert row in SENTENCES
    for one, other, scale in (
        ((1, 1), (10, 10), 10), ((0.1, 1), (1, 10), 10), ((0.01, 1), (0.1, 10), 10)
    ):  # fmt: skip
        one, other = rows[one], rows[other]
        assert one["error"] == pytest.approx(other["error"], rel=1e-3)
        assert one["lag1"] == pytest.approx(other["lag1"], abs=1e-3)
        assert one["nis"] / other["nis"] == pytest.approx(scale, rel=1e-3)


def test_the_interval_of_the_mean_nis_is_the_one_in_the_guide():
    low, high = estimation.nis_interval(1950, 1)
    assert f"one angle the mean NIS should lie between {low:.3f} and {high:.3f}" in (
        SENTENCES
    )


def test_the_best_gain_leaves_an_error_that_the_innovation_does_not_predict():
    """The derivation of 9.5: any other gain adds D S D^T to the covariance."""
    rng = np.random.default_rng(9)
    P, H, R = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([[1.0, 0.0]]), np.eye(1)
    S = H @ P @ H.T + R
    _, after, _ = lab.kalman_update(np.zeros(2), P, np.array([3.0]), H, R)
    K = P @ H.T @ np.linalg.inv(S)
    assert np.allclose(P @ H.T - K @ S, 0)
    for _ in range(10):
        D = rng.normal(size=(2, 1))
        left = np.eye(2) - (K + D) @ H
        other = left @ P @ left.T + (K + D) @ R @ (K + D).T
        assert np.allclose(other, after + D @ S @ D.T)


@pytest.mark.kit
def test_the_autocorrelation_reveals_the_filter_that_passes_the_nis_test():
    true, other = [], []
    low, high = estimation.nis_interval(1950, 1)
    for seed in range(1, 21):
        z, _ = lab.wandering(np.random.default_rng(seed))
        true.append(lab.track(z, lab.WANDERS, lab.NOISE**2))
        other.append(lab.track(z, lab.WANDERS / 10, 10 * lab.NOISE**2))
    lag1 = [
        [abs(estimation.lag1_autocorrelation(one["innovation"])) for one in side]
        for side in (true, other)
    ]
    off = max(abs(one["nis"].mean() - 1) for one in true)
    passes = sum(low < one["nis"].mean() < high for one in other)
    assert "In 20 runs with different seeds" in SENTENCES
    assert f"passes the NIS test {passes} times" in SENTENCES
    assert max(lag1[0]) < 0.042 < 0.86 < min(lag1[1])
    assert "never below 0.86" in SENTENCES
    assert off < 0.1  # the limit in day.toml


def test_without_process_noise_the_filter_ignores_its_readings():
    z, qd = lab.wandering(np.random.default_rng(lab.SEED))
    with patch.object(lab, "kalman_predict", lambda x, P, F, Q: (F @ x, F @ P @ F.T)):
        output = lab.track(z, lab.WANDERS, lab.NOISE**2)
    error = output["velocity"] - qd[lab.SETTLED :]
    assert output["nis"].mean() > 1000
    assert np.mean(np.abs(error) < 1.96 * output["sigma"]) < 0.1
    assert f"wrong by {lab.rms(error):.1f} rad/s" in SENTENCES
    assert lab.rms(output["sigma"]) < 0.001


KNOWN = {  # the known torques of a step, from the sample before and the newest one
    "lab": lambda old, new, h: old.grad - old.gravity - old.damping,
    "newest": lambda old, new, h: new.grad - new.gravity - new.damping,
    "mean": lambda old, new, h: (
        KNOWN["lab"](old, new, h) + KNOWN["newest"](old, new, h)
    ) / 2,
    "MuJoCo": lambda old, new, h: (
        -old.bias - new.damping + (new.M - old.M) @ new.qd / h
    ),
}  # fmt: skip


def sampled(q, qd):
    """Return the terms of the observer at one sample."""
    now = arm.at(q)
    grad = lab.kinetic_energy_gradient(now.J_space, now.G, qd)
    return SimpleNamespace(
        M=now.M, qd=qd, grad=grad, gravity=now.gravity_torque, bias=now.bias(qd),
        damping=arm.damping * qd,
    )  # fmt: skip


def unexplained(run, h, rule):
    """Return the largest residual of an observer with a rule for the known torques."""
    samples = [sampled(q, qd) for q, qd in zip(run.q[:-1], run.qd[:-1], strict=True)]
    residual, integral = np.zeros(7), samples[0].M @ samples[0].qd
    found = []
    for old, new, tau in zip(samples, samples[1:], run.tau, strict=False):
        integral = integral + (tau + KNOWN[rule](old, new, h) + residual) * h
        residual = lab.GAIN * (new.M @ new.qd - integral)
        found.append(residual)
    return largest(found)


@pytest.mark.kit
def test_the_rest_in_free_motion_is_mujocos_rule_and_neither_gain_nor_age(swing):
    """Every cause of first order halves with the step; only one leaves nothing."""
    left = {}
    for gain in (10.0, 50.0, 200.0):
        with patch.object(lab, "GAIN", gain):
            left[gain] = largest(lab.felt(arm, swing))
    assert [f"{x:.3f}" for x in left.values()] == ["0.008", "0.009", "0.009"]
    assert "The gain hardly changes the remaining 0.009 N m" in SENTENCES
    law = day9_mujoco.tracking(arm, SWING)
    found = {}
    for h in (0.002, 0.001):
        other = copy.copy(model)
        other.opt.timestep = h
        run = simulate.run(other, simulate.start(other, Q), law, 1.0, rate=1 / h)
        found[h] = {rule: unexplained(run, h, rule) for rule in KNOWN}
    for rule in ("lab", "newest", "mean"):
        assert found[0.001][rule] == pytest.approx(found[0.002][rule] / 2, rel=0.01)
    assert max(one["MuJoCo"] for one in found.values()) < 1e-9
    assert found[0.002]["newest"] / found[0.002]["lab"] == pytest.approx(4, abs=0.2)


@pytest.mark.kit
def test_at_rest_every_slope_finds_the_push_and_in_motion_one(held, swing):
    at_rest = [lab.felt(arm, held, share) for share in (1, 0, -1)]
    for other in at_rest[1:]:
        assert np.abs(at_rest[0] - other).max() < 1e-3  # while it gives way
        assert np.abs(at_rest[0] - other)[-1].max() < 1e-6
        assert lab.notices(other) == lab.notices(at_rest[0])
    free = [largest(lab.felt(arm, swing, share)) for share in (1, 0, -1)]
    assert free[0] < 0.01 < lab.THRESHOLD < free[1] < free[2]
    without, negated = (f"{x:.2f} N m" for x in free[1:])
    says = f"residual is {without} without the gradient and {negated} with the gradient"
    assert says in SENTENCES


def test_the_residual_is_at_63_per_cent_after_one_over_the_gain(held):
    times = []
    for gain in (25.0, 50.0, 100.0, 200.0):
        with (
            patch.object(lab, "GAIN", gain),
            patch.object(lab, "THRESHOLD", 0.63 * 4.709),
        ):
            after = lab.notices(lab.felt(arm, held))
        assert after == pytest.approx(1000 / gain, abs=2.1)
        times.append(f"{after:.0f}")
    assert f"You measure {times[0]}, {times[2]} and {times[3]} ms" in SENTENCES
    up = [f"{2 * np.ceil(1000 / gain / 2):.0f}" for gain in (25, 100, 200)]
    assert f"gives {up[0]}, {up[1]} and {up[2]}" in SENTENCES
    discrete = 1 - (1 - 200 * lab.DT) ** 2  # the sum is not an integral
    assert discrete == pytest.approx(0.64)


def test_a_large_gain_overshoots_from_1_over_dt_and_is_unstable_from_2_over_dt(held):
    peak = {}
    for gain in (400.0, 600.0, 900.0):
        with patch.object(lab, "GAIN", gain):
            residual = np.abs(lab.felt(arm, held)[:, lab.JOINT])
        peak[gain] = residual.max() / residual[-1]
    assert peak[400.0] < 1.01
    assert peak[600.0] > 1.1
    assert peak[900.0] > 1.6
    with patch.object(lab, "GAIN", 2.2 / lab.DT), np.errstate(all="ignore"):
        pushed = lab.felt(arm, held)
    assert not np.abs(pushed).max() < 1e6


@pytest.mark.kit
def test_errors_of_the_model_look_like_a_contact(swing):
    hung = copy.copy(model)
    hung.body("link7").mass += 0.5  # as the guide has it
    at_rest = largest(lab.felt(arm, day9_mujoco.moved(hung, arm, STAY, 0.8))[-1])
    swings = largest(lab.felt(arm, day9_mujoco.moved(hung, arm, SWING, 1.0)))
    assert (
        f"= {at_rest:.2f} N m at rest, and {swings:.2f} N m in the swing" in SENTENCES
    )
    now = arm.at(Q)
    data = simulate.start(model, Q)
    lever = now.coms_world[6, 0] - data.joint("joint4").xanchor[0]
    assert f"{lever:.4f} m in front of the axis of joint 4" in SENTENCES
    assert 0.5 * 9.81 * lever == pytest.approx(at_rest, abs=0.005)
    rubs = copy.copy(model)
    rubs.dof_frictionloss[:7] = 0.5
    mujoco.mj_setConst(rubs, mujoco.MjData(rubs))
    residual = lab.felt(arm, day9_mujoco.moved(rubs, arm, SWING, 1.0))
    words = (
        f"largest residual is {largest(residual):.2f} N m, "
        "and the residual of every joint exceeds 0.5 N m"
    )
    assert words in SENTENCES
    assert np.abs(residual).max(axis=0).min() > 0.5
    way = swing._replace(q=swing.q[:500], qd=swing.qd[:500], tau=swing.tau[:500])
    seen = []
    for cutoff in (None, 50.0, 20.0):
        qd = lab.speeds(lab.encoder(way.q, 16))
        if cutoff:
            qd = estimation.low_pass(qd, lab.DT, cutoff)
        seen.append(f"{largest(lab.felt(arm, way._replace(qd=qd))):.1f}")
    assert f"You measure {seen[0]} N m without a filter, and" in SENTENCES
    assert f"and {seen[1]} and {seen[2]} N m with the two low passes" in SENTENCES
    row = np.abs(now.M[1]).sum()
    assert f"add up to {row:.2f} kg m²" in SENTENCES
    assert (
        f"= {50 * row * 2 * np.pi / 2**16 / lab.DT:.1f} N m. You measure" in SENTENCES
    )


def test_joint_7_does_not_feel_a_push_whose_line_meets_its_axis():
    torque = lab.mujoco_external_torque(model, Q, lab.FLANGE, lab.FORCE)
    assert abs(torque[6]) < 1e-12 < lab.THRESHOLD < abs(torque[5])
    aside = Q.copy()
    aside[4] += 0.8  # the hand no longer hangs straight down ...
    tilted = arm.at(aside)
    n, p = tilted.T_world_ee[:3, 2], tilted.T_world_ee[:3, 3]
    off_axis = p + 0.1 * np.cross(n, [0.0, 0.0, 1.0])  # ... and the push goes past it
    moment = np.cross(off_axis, lab.FORCE)
    felt = tilted.J_space[:, 6] @ np.concatenate([moment, lab.FORCE])
    assert abs(felt) > 0.1


def named(model_, name, force):
    """Return the contact link that the lab's demonstration names."""
    observer, limit = lab.Observer(arm), np.full(7, lab.THRESHOLD)
    push = day9_mujoco.push(name, force, lab.SINCE)
    return day9_mujoco.stopped(
        model_, arm, observer, lambda r: lab.contact_link(r, limit), push
    ).link


@pytest.mark.kit
def test_which_link_is_named_is_a_matter_of_levers_and_of_the_model(swing):
    q = swing.q[round(lab.SINCE / lab.DT)]
    lever = -arm.at(q).coms_world[1, 0]
    assert f"only {1000 * lever:.0f} mm behind the axis of joint 1" in SENTENCES
    small = lab.mujoco_external_torque(model, q, "link2", np.array([0, 20.0, 0]))
    assert f"so a push of 20 N causes only {largest(small):.2f} N m" in SENTENCES
    sideways = lab.mujoco_external_torque(model, q, lab.FLANGE, np.array([0, 20.0, 0]))
    assert abs(sideways[5]) < lab.THRESHOLD
    fourth = lab.mujoco_external_torque(model, q, "link4", np.array([0, 20.0, 0]))
    assert abs(fourth[3]) < lab.THRESHOLD
    assert named(model, "link2", (0, 20, 0)) == 0
    assert named(model, "link2", (0, 30, 0)) == 1
    hung = copy.copy(model)
    hung.body("link7").mass += 0.5
    push = day9_mujoco.push("link3", np.array([0, 20.0, 0]), lab.SINCE)
    limit = np.full(7, lab.THRESHOLD)
    for one, link in ((model, 3), (hung, 4)):
        at_rest = lab.felt(arm, day9_mujoco.moved(one, arm, STAY, 0.8, push))[-1]
        assert lab.contact_link(at_rest, limit) == link


@pytest.mark.kit
def test_the_claims_of_the_opening_are_what_the_lab_prints(printed):
    assert "detection time, ms: 4 (limit 10)" in printed
    wrong = re.search(r"accel_psd / 10, R x 10 .* yes +0\.868 +53\.5%", printed)
    assert wrong
    error, sigma, nis = wrong.group().split()[6:9]
    assert f"The result of the test is {nis}" in SENTENCES
    best = float(re.search(r"correct +([\d.]+)", printed).group(1))
    assert 1.6 < float(error) / best < 1.72  # two thirds larger than necessary
    assert float(sigma) / float(error) == pytest.approx(1 / 3, abs=0.04)
    assert "46 % of the true velocities lie outside" in SENTENCES
    pushed = [line.split()[-3:] for line in printed.splitlines() if ", (0, " in line]
    after = [float(row[1]) for row in pushed if row[1] != "inf"]
    assert f"detected after {min(after):.0f} to {max(after):.0f} ms" in SENTENCES
    moves = max(float(row[2]) for row in pushed if row[2] != "inf")
    assert f"moves on by up to {moves:.0f} mm" in SENTENCES


def test_the_examples_on_paper_come_out():
    """Two hinges and a point mass, a critically damped crossover, a half-way lag."""
    z, along = np.array([0.0, 0.0, 1.0]), np.array([1.0, 1.0, 0.0])
    second = np.array([1.0, 0.0, 0.0])
    J = np.column_stack([np.r_[z, 0, 0, 0], np.r_[z, -np.cross(z, second)]])
    to_point = np.hstack([-skew(along), np.eye(3)])  # a twist's velocity of the mass
    G = np.array([np.zeros((6, 6)), to_point.T @ to_point])
    gradient = lab.kinetic_energy_gradient(J, G, np.array([1.0, 0.0]))
    assert np.allclose(gradient, [0.0, -1.0])
    w = np.sqrt((4 + np.sqrt(20)) / 2)  # omega is 1
    assert f"$w = {w:.3f} \\omega$" in SENTENCES
    assert f"$T_d = {lab.delay_margin(1.0, 2.0):.4f} / \\omega$" in SENTENCES
    half = np.log(2) / (2 * np.pi)  # the cutoff, with dt = 1, of alpha = 1 / 2
    ramp = np.arange(60.0)
    assert ramp[-1] - lab.low_pass(ramp, 1.0, half)[-1] == pytest.approx(1.0)


def test_the_gradient_is_the_transposed_coriolis_matrix_times_qd():
    qd = np.random.default_rng(9).uniform(-2, 2, 7)
    now = arm.at(Q)
    C = dynamics.coriolis_matrix(now.J_space, now.G, qd)
    gradient = lab.kinetic_energy_gradient(now.J_space, now.G, qd)
    assert np.allclose(gradient, C.T @ qd)
    assert np.abs(gradient - C @ qd).max() > 0.1
    h = 1e-6
    change = (arm.at(Q + h * qd).M - arm.at(Q - h * qd).M) / (2 * h)
    assert np.allclose(change, C + C.T, atol=1e-6)

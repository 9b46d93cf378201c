"""Day 9: the numbers in the guide's sentences, and every reason in it."""

import copy
import io
import re
from contextlib import redirect_stdout
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script
from robo47 import estimation, panda, simulate

import day9_mujoco
from day9_mujoco import STAY, SWING

GUIDE = (ROOT / "w2-autonomy/docs/day9-lab.md").read_text("utf-8")
OWN = re.sub(r"<!-- run.*?<!-- end -->", "", GUIDE, flags=re.S)
SENTENCES = " ".join(OWN.replace("*", "").split())
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
            "a push of 10 N is noticed after, ms": "4",
            "residual of joint 4, N m": "-4.7"}  # fmt: skip
    with (
        patch("sys.argv", ["lab", "--no-log"]),
        patch("labkit.lesson.lab.predictions", lambda worksheet: told),
        redirect_stdout(io.StringIO()) as out,
    ):
        assert lab.main() == 0
    assert all(len(line) <= 80 for line in out.getvalue().splitlines())
    return out.getvalue()


def largest(residual):
    """Return the largest residual, N m."""
    return float(np.abs(residual).max())


@pytest.mark.kit
def test_three_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day9.md").read_text("utf-8")
    for row, said in {
        "noise of a 16-bit difference, rad/s": "measured 0.01955",
        "a push of 10 N is noticed after, ms": "measured 4",
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
    assert "With RK4 the same difference is 0.40 rad/s off" in SENTENCES


def test_twelve_bits_are_too_coarse_for_the_prediction_since_neighbours_share_errors(
    swing,
):
    ratio, shared = [], []
    for bits in (12, 16, 18):
        said = lab.encoder(swing.q, bits)
        step = 2 * np.pi / 2**bits
        off = lab.speeds(said)[1:] - swing.qd[1:]
        ratio.append(lab.rms(off) / (step / np.sqrt(6) / lab.DT))
        error = (said - swing.q).T
        shared.append(np.mean([estimation.lag1_autocorrelation(one) for one in error]))
    assert abs(ratio[0] - 0.95) < 0.01
    assert max(abs(r - 1) for r in ratio[1:]) < 0.01
    assert shared[0] > 0.05 > abs(shared[2])
    assert "At 12 bits the prediction is 5 % too large" in SENTENCES


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
            f"{1000 * margin:.2f} ms; at 32 ms the error is then {left[1]:.0f} times"
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


@pytest.mark.kit
def test_it_is_not_rounding_but_the_motion_that_spoils_the_nis_of_the_swing(swing):
    q, qd = swing.q[:, lab.JOINT], swing.qd[:, lab.JOINT]
    R = (2 * np.pi / 2**16) ** 2 / 12
    z = lab.encoder(swing.q, 16)[:, lab.JOINT]
    noisy = q + np.sqrt(R) * np.random.default_rng(lab.SEED).normal(size=len(q))
    means = {
        intensity: [
            f"{lab.track(one, intensity, R)['nis'].mean():.2f}" for one in (z, noisy)
        ]
        for intensity in (1.0, 0.1)
    }
    assert f"1 it brings it from {means[1.0][0]} to {means[1.0][1]}" in SENTENCES
    assert f"at q = 0.1 from {means[0.1][0]} to {means[0.1][1]}" in SENTENCES
    # A joint that moves as the filter believes, read by the same encoder: NIS is 1.
    step = 2 * np.pi / 2**16
    with patch.object(lab, "NOISE", 0.0):
        believed, _ = lab.wandering(np.random.default_rng(lab.SEED))
    rounded = np.round(believed / step) * step
    assert abs(lab.track(rounded, lab.WANDERS, R)["nis"].mean() - 1) < 0.1
    off = [
        lab.rms(lab.track(z, intensity, R)["speed"] - qd[lab.SETTLED :])
        for intensity in (0.001, 0.01, 0.1, 1.0)
    ]
    raw = estimation.backward_difference(z, lab.DT)
    best = min(
        lab.rms((estimation.low_pass(raw, lab.DT, f) - qd)[lab.SETTLED :])
        for f in np.geomspace(5, 200, 40)
    )
    assert min(off) == off[1] < best


@pytest.mark.kit
def test_whiteness_tells_the_filter_that_nis_lets_pass():
    true, other = [], []
    low, high = estimation.nis_interval(1950, 1)
    for seed in range(1, 21):
        z, _ = lab.wandering(np.random.default_rng(seed))
        true.append(lab.track(z, lab.WANDERS, lab.NOISE**2))
        other.append(lab.track(z, lab.WANDERS / 10, 10 * lab.NOISE**2))
    white = [
        [abs(estimation.lag1_autocorrelation(one["surprise"])) for one in side]
        for side in (true, other)
    ]
    off = max(abs(one["nis"].mean() - 1) for one in true)
    passes = sum(low < one["nis"].mean() < high for one in other)
    assert f"off by up to {off:.3f}" in SENTENCES
    assert f"passes in {passes} of 20" in SENTENCES
    assert max(white[0]) < 0.042 < 0.86 < min(white[1])
    assert off < 0.1  # the limit in day.toml


def test_the_filter_that_never_grows_unsure_falls_asleep():
    z, qd = lab.wandering(np.random.default_rng(lab.SEED))
    with patch.object(lab, "kalman_predict", lambda x, P, F, Q: (F @ x, F @ P @ F.T)):
        said = lab.track(z, lab.WANDERS, lab.NOISE**2)
    inside = np.abs(said["speed"] - qd[lab.SETTLED :]) < 1.96 * said["sigma"]
    assert said["nis"].mean() > 1000
    assert inside.mean() < 0.1


@pytest.mark.kit
def test_what_is_left_in_free_motion_is_the_sample_and_not_the_gain(swing):
    left = {}
    for gain in (10.0, 50.0, 200.0):
        with patch.object(lab, "GAIN", gain):
            left[gain] = largest(lab.felt(arm, swing))
    assert [f"{x:.3f}" for x in left.values()] == ["0.008", "0.009", "0.009"]
    faster = copy.copy(model)
    faster.opt.timestep = 0.001
    law = day9_mujoco.tracking(arm, SWING)
    run = simulate.run(faster, simulate.start(faster, Q), law, 1.0, rate=1000.0)
    with patch.object(lab, "DT", 0.001):
        half = largest(lab.felt(arm, run))
    assert half == pytest.approx(left[50.0] / 2, rel=0.01)


@pytest.mark.kit
def test_at_rest_every_slope_finds_the_push_and_in_motion_one(held, swing):
    at_rest = [lab.felt(arm, held, share) for share in (1, 0, -1)]
    for other in at_rest[1:]:
        assert np.abs(at_rest[0] - other).max() < 1e-3  # while it gives way
        assert np.abs(at_rest[0] - other)[-1].max() < 1e-6
        assert lab.notices(other) == lab.notices(at_rest[0])
    free = [largest(lab.felt(arm, swing, share)) for share in (1, 0, -1)]
    assert free[0] < 0.01 < lab.THRESHOLD < free[1] < free[2]
    assert f"{free[1]:.2f} and {free[2]:.2f} N m" in SENTENCES


def test_the_residual_is_at_63_per_cent_after_one_over_the_gain(held):
    times = []
    for gain in (25.0, 50.0, 100.0, 200.0):
        with patch.object(lab, "GAIN", gain):
            share = np.abs(lab.felt(arm, held)[:, lab.JOINT])
        after = 1000 * (np.argmax(share > 0.632 * share[-1]) * lab.DT - lab.SINCE)
        assert after == pytest.approx(1000 / gain, abs=2.1)
        times.append(f"{after:.0f}")
        with (
            patch.object(lab, "GAIN", gain),
            patch.object(lab, "THRESHOLD", 0.63 * 4.709),
        ):
            assert lab.notices(lab.felt(arm, held)) == pytest.approx(after)
    assert f"{times[0]}, {times[2]} and {times[3]} ms: 1 / gain" in SENTENCES
    with patch.object(lab, "GAIN", 2.2 / lab.DT), np.errstate(all="ignore"):
        pushed = lab.felt(arm, held)
    assert not np.abs(pushed).max() < 1e6  # over 2 / dt it blows up


@pytest.mark.kit
def test_what_the_observer_takes_for_a_push(swing):
    hung = copy.copy(model)
    hung.body("link7").mass += 0.5  # as the guide has it
    at_rest = largest(lab.felt(arm, day9_mujoco.moved(hung, arm, STAY, 0.8))[-1])
    swings = largest(lab.felt(arm, day9_mujoco.moved(hung, arm, SWING, 1.0)))
    assert f"{at_rest:.2f} N m at rest, and {swings:.2f} in the swing" in SENTENCES
    rubs = copy.copy(model)
    rubs.dof_frictionloss[:7] = 0.5
    mujoco.mj_setConst(rubs, mujoco.MjData(rubs))
    residual = lab.felt(arm, day9_mujoco.moved(rubs, arm, SWING, 1.0))
    assert f"{largest(residual):.2f} N m, and over 0.5 on every joint" in SENTENCES
    assert np.abs(residual).max(axis=0).min() > 0.5
    way = swing._replace(q=swing.q[:500], qd=swing.qd[:500], tau=swing.tau[:500])
    seen = []
    for cutoff in (None, 50.0, 20.0):
        qd = lab.speeds(lab.encoder(way.q, 16))
        if cutoff:
            qd = estimation.low_pass(qd, lab.DT, cutoff)
        seen.append(f"{largest(lab.felt(arm, way._replace(qd=qd))):.1f}")
    assert f"{seen[0]}, {seen[1]} and {seen[2]} N m: M times the noise" in SENTENCES


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
    sideways = lab.mujoco_external_torque(model, Q, "link2", np.array([0.0, 20.0, 0.0]))
    assert largest(sideways) < lab.THRESHOLD


@pytest.mark.kit
def test_the_gripped_sentences_of_the_idea_are_what_is_printed(printed):
    assert "noticed, ms: 4 (limit 10)" in printed
    assert re.search(r"q / 10 and R x 10 .* yes +0\.868", printed)
    assert "46 in 100 of its speeds lie outside" in SENTENCES
    assert re.search(r"q / 10 and R x 10 .* 53\.5%", printed)

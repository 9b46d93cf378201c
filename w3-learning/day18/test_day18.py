"""Day 18: the numbers in the guide's sentences, and every reason in it."""

import contextlib
import io
import re
from functools import cache
from math import erfc, sqrt
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences

import day15_mujoco

SENTENCES = sentences(18)
lab = load_script(ROOT / "w3-learning/src/day18_evaluation.py")
SILENT = SimpleNamespace(
    training=lambda title, steps: range(1, steps + 1), check=lambda *_: None
)


@cache
def home(seed, actions):
    """Return the successes of a policy that drives so many actions in each round."""
    with patch.multiple(lab, SEED=seed):
        return lab.outcomes(lab.learned(SILENT, actions))


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    asked = {"lateral error with the gain 1, mm": "5", "the best of six tests": "0.8",
             "two tests that are 5 or more apart": "0.3"}  # fmt: skip
    return printed_by(lab, asked)


# What a student's run tells in a second.


def test_the_growth_on_paper():
    a, step = lab.growth(1.0)
    slip = np.exp(0.1 * 0.1 / 0.065)
    moved = (slip - 1) * 0.065 / 0.1
    assert f"$E$ is {slip:.3f} and $g$ is {moved:.3f} s" in SENTENCES
    words = f"$a$ = {slip:.3f} - {moved:.3f} = {a:.3f}, and the added error is "
    assert words + f"{1e3 * step:.3f} mm" in SENTENCES
    assert f"the distance is {1e3 * lab.error_after(a, step, 24):.2f} mm. With" in (
        SENTENCES
    )
    a, step = lab.growth(3.0)
    last = 1e3 * lab.error_after(a, step, 24)
    assert f"$a$ is {a:.3f}, and the distance is {last:.2f} mm" in SENTENCES
    assert f"predicts {24e3 * step:.2f} mm instead of {last:.2f} mm" in SENTENCES
    assert lab.error_after(1.1, 0.1, 2) == pytest.approx(0.21)
    assert "you should obtain 0.21" in SENTENCES


def test_the_factor_is_1_where_the_gain_is_v_over_R():
    a, _ = lab.growth(0.1 / 0.065)
    assert a == pytest.approx(1.0, abs=1e-12)
    assert "At $K = v / R$ it is exactly 1" in SENTENCES


def test_less_mass_brings_the_error_closer_to_the_prediction():
    light = [1e3 * lab.measured_error(K, mass=0.025) for K in (1.0, 0.0)]
    words = (
        f"{light[0]:.2f} mm with a gain of 1, and {light[1]:.1f} mm without steering"
    )
    assert words in SENTENCES
    for K, mine in zip((1.0, 0.0), light, strict=True):
        predicted = 1e3 * lab.error_after(*lab.growth(K), 24)
        heavy = 1e3 * lab.measured_error(K)
        assert abs(mine - predicted) < 0.5 * abs(heavy - predicted)


def test_the_error_does_not_depend_on_a_small_gap_at_the_start():
    moved = 1e-12 + day15_mujoco.R
    with patch.object(lab, "R", moved):
        off = lab.measured_error(1.0)
    assert off == pytest.approx(lab.measured_error(1.0), rel=1e-6)


def test_without_a_shift_a_split_by_episode_mixes_two_episodes():
    of = np.array([0, 0, 1])
    rows = np.zeros((3, 4)), np.zeros((3, 2)), of
    both = lab.aggregate(rows, rows)
    held = np.isin(both[2], [1])
    assert held.tolist() == [False, False, True, False, False, False]
    assert np.isin(np.append(of, of), [1]).sum() == 2


def test_the_sign_test_on_paper():
    one = np.arange(7) < 6
    assert lab.sign_test(one, ~one) == 0.125
    seven = np.arange(8) < 7
    p = lab.sign_test(seven, ~seven)
    assert f"7 wins and 1 loss you should obtain {p:.4f}" in SENTENCES
    five = np.zeros(5, dtype=bool)
    assert lab.sign_test(five, ~five) == 0.0625
    assert "p-value of 5 losses and no win is 0 instead of 0.0625" in SENTENCES
    assert f"gives {erfc(sqrt(5) / sqrt(2)):.3f} for this case" in SENTENCES
    six = np.ones(6, dtype=bool)
    assert f"$2 / 2^6$ = {lab.sign_test(six, ~six):.3f}" in SENTENCES
    four = np.arange(6) < 4
    assert f"between the methods ($p$ = {lab.sign_test(four, ~four):.2f})" in SENTENCES
    many = np.zeros(200, dtype=bool)
    some = np.arange(200) < 20
    assert f"a p-value of {lab.sign_test(some, many):.6f}, whatever" in SENTENCES


def test_the_symptoms_of_two_mistakes_are_those_of_the_table():
    with pytest.raises(TypeError, match="ufunc 'invert' not supported"):
        _ = ~np.ones(2)
    assert "`TypeError: ufunc 'invert' not supported`" in SENTENCES
    # 177 and 139 successes, instead of 48 wins and 10 losses
    total, own = np.arange(316) < 177, np.arange(58) < 48
    assert 1e4 * lab.sign_test(own, ~own) < lab.sign_test(total, ~total) < 0.1
    assert "the p-value is much too large" in SENTENCES


def test_rates_that_are_compared_as_floats_lose_pairs():
    assert not 0.74 - 0.64 >= 0.1
    k = np.arange(51)
    pmf = lab.binomial_pmf(50, 0.7)
    far = np.abs(k[:, None] / 50 - k / 50) >= 0.1
    wrong = np.outer(pmf, pmf)[far].sum()
    right = lab.gap_by_luck(0.7, 50, 5)
    assert f"makes the result too small by {right - wrong:.2f}" in SENTENCES


def test_the_power_on_paper():
    assert lab.paired_power(0.6, 0.0, 6, 0.05) == pytest.approx(0.6**6)
    assert f"$0.6^6$ = {0.6**6:.3f}" in SENTENCES


def test_the_number_of_starts_for_a_power():
    some = [lab.paired_power(0.24, 0.05, n, 0.05) for n in (64, 65)]
    assert some[0] < 0.8 <= some[1]
    assert "65 is the smallest number of starts" in SENTENCES


def test_doubled_weights_change_nothing():
    rng = np.random.default_rng(0)
    pred, target = rng.normal(size=(2, 4, 2))
    weight = rng.uniform(0, 1, 4)
    one, two = (lab.weighted_mse(pred, target, k * weight) for k in (1, 2))
    assert one[0] == pytest.approx(two[0])
    assert one[1] == pytest.approx(two[1])


@pytest.mark.kit
def test_a_small_difference_needs_many_starts():
    some = [lab.paired_power(0.145, 0.095, n, 0.05) for n in (760, 800)]
    assert some[0] < 0.8 < some[1]
    assert "the test needs about 790 starts" in SENTENCES


def test_pairing_does_not_help_where_successes_hardly_depend_on_the_start():
    own = lab.paired_power(0.24, 0.05, 50, 0.05)
    k = np.arange(51)
    a, b = k[:, None] / 50, k / 50
    spread = np.sqrt(np.maximum((a + b) * (1 - (a + b) / 2) / 50, 1e-12))
    chance = np.outer(lab.binomial_pmf(50, 0.885), lab.binomial_pmf(50, 0.695))
    other = chance[np.abs(a - b) >= 1.959964 * spread].sum()
    assert f"its power is {other:.2f}, about as large as" in SENTENCES
    assert other == pytest.approx(own, abs=0.02)
    # The same rates, and a correlation of 0.5: the cause is changed.
    common = 0.885 * 0.695 + 0.5 * np.sqrt(0.885 * 0.115 * 0.695 * 0.305)
    paired = lab.paired_power(0.885 - common, 0.695 - common, 50, 0.05)
    assert paired > other + 0.15


def test_the_best_of_two_coins():
    assert lab.best_of(0.5, 1, 2) == 0.75
    assert "The expected rate of the best is 3/4" in SENTENCES
    excess = 100 * (lab.best_of(0.695, 20, 6) - 0.695)
    assert f"expected to be {excess:.0f} percentage points too high" in SENTENCES


def test_looking_often_finds_differences_that_are_not_there():
    often = lab.looks(np.random.default_rng(0), 0.7, 1000)
    assert often == pytest.approx(0.16, abs=0.02)
    assert "equal policies is about 16 %, not 5 %" in SENTENCES


def test_the_weight_of_standing_still():
    _, _, of = lab.dawdling()
    still = lab.WAIT * (lab.DAWDLERS // 2)
    assert f"There are {len(of)} rows" in SENTENCES
    assert still / len(of) == 0.5
    weight = lab.episode_weights(of)
    assert weight[:still].sum() / weight.sum() == pytest.approx(1 / 3)
    assert (
        "two thirds of their rows the pusher stands still, so the fraction is 33 %"
        in SENTENCES
    )


@pytest.mark.kit
def test_the_opening_is_what_the_lab_prints(printed):
    counts = [int(n) for n in re.findall(r"about +(\d+) of 200", printed)]
    assert counts == pytest.approx([175, 140], abs=10)
    assert re.search(r"\W*about 175 of 200\W* pucks home", SENTENCES)
    assert re.search(r"\W*about 140\W*", SENTENCES)
    p = float(re.search(r"sign test: p = (\S+)", printed)[1])
    assert p < 1e-5
    low = int(re.search(r"at most 0.05 in (\d+) % of the trials,", printed)[1])
    kept = int(re.search(r"by Holm's method in (\d+) %", printed)[1])
    assert low == pytest.approx(25, abs=6)
    assert kept <= 5
    assert "about a quarter of the trials report a difference" in SENTENCES


# What only an author can break.


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 6])
def test_fresh_demonstrations_beat_dagger(seed):
    row = {0: [175, 195, 180, 150, 155, 170], 20: [200, 200, 165, 170, 180, 150],
           60: [140, 80, 155, 130, 145, 105]}  # fmt: skip
    for values in row.values():
        text = f"about {values[0]} | " + " | ".join(map(str, values[1:]))
        assert text in SENTENCES
    counts = {k: np.sum(home(seed, k)) for k in row}
    for k, values in row.items():
        assert counts[k] == pytest.approx(values[seed - 1], abs=8)
    assert counts[60] < min(counts[0], counts[20])


@pytest.mark.kit
def test_the_networks_of_seed_5_do_not_differ():
    p = lab.sign_test(home(5, 0), home(5, 60))
    assert p == pytest.approx(0.43, abs=0.15)
    assert "For seed 5 alone the p-value of the two networks is about 0.4" in SENTENCES


@pytest.mark.kit
def test_wins_losses_and_correlation_are_those_of_the_guide():
    fresh, own = home(1, 0), home(1, 60)
    wins, losses = np.sum(fresh & ~own), np.sum(own & ~fresh)
    assert (wins, losses) == pytest.approx((48, 10), abs=4)
    assert (
        "succeeded on 48 of the 200 starts. On 10 starts only the second" in SENTENCES
    )
    together = np.corrcoef(fresh, own)[0, 1]
    assert together == pytest.approx(0.20, abs=0.06)
    assert "the correlation of the successes is only 0.20" in SENTENCES
    assert np.mean(own) == pytest.approx(0.695, abs=0.03)


@pytest.mark.kit
@pytest.mark.parametrize(("seed", "own", "demos"), [(1, 42, 60), (2, 9, 65)])
def test_the_pucks_of_dagger_are_seldom_near_home(seed, own, demos):
    start = day15_mujoco.starts(30, np.random.default_rng(seed))
    with patch.object(lab, "SEED", seed):
        policy = lab.train(SILENT, "", lab.collect(start[:10], None, 0))
    assert np.mean(lab.outcomes(policy, 100)) < 0.5
    assert "A policy that was trained on 10 episodes fails in most of its" in SENTENCES
    near = []
    for k in (0, 60):
        seen, _, _ = lab.collect(start[10:20], policy, k)
        near.append(100 * np.mean(np.linalg.norm(seen[:, 2:], axis=1) < 0.1))
    assert near == pytest.approx([demos, own], abs=3)
    assert f"{demos} %" in SENTENCES
    assert f"{own} %" in SENTENCES


@pytest.mark.kit
def test_dagger_helps_the_copycat():
    with patch.multiple(lab, WITH_LAST=True, EACH=20, ROUNDS=4):
        counts = [np.sum(lab.outcomes(lab.learned(SILENT, k))) for k in (0, 60)]
    assert counts == pytest.approx([20, 145], abs=10)
    assert "about 20 | 35 | 40" in SENTENCES
    assert "about 145 | 125 | 155" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize(("seed", "told"), [(2, (0, 0, 70)), (6, (45, 20, 90))])
def test_weights_help_little_and_leaving_out_helps(seed, told):
    with (
        patch.object(lab, "SEED", seed),
        contextlib.redirect_stdout(io.StringIO()),
    ):
        counts = [np.sum(some) for some in lab.hesitation(SILENT)]
    assert counts == pytest.approx(told, abs=8)
    words = "about 0, 0 and 70 pucks home, and with seed 6 about 45, 20 and 90"
    assert words in SENTENCES

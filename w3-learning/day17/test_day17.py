"""Day 17: the numbers in the guide's sentences, and every reason in it."""

import contextlib
import io
import re
from functools import cache
from statistics import NormalDist
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import cloning, diffusion, push

SENTENCES = sentences(17)
lab = load_script(ROOT / "w3-learning/src/day17_diffusion.py")
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))
NORMAL = NormalDist()


@cache
def rows(seed=lab.SEED):
    """Return observations and plans of demonstrations."""
    with patch.object(lab, "SEED", seed), contextlib.redirect_stdout(io.StringIO()):
        return lab.demonstrations()


@contextlib.contextmanager
def changed(**constants):
    """Change constants or functions of the lab."""
    with patch.multiple(lab, **constants) if constants else contextlib.nullcontext():
        yield


@cache
def trained(method="diffusion", plan=True, schedule=lab.cosine_schedule):
    """Return a planner and its loss."""
    with changed(METHOD=method, PREDICTS_PLAN=plan, cosine_schedule=schedule):
        return lab.train(SILENT, *rows())


def home(planner, steps=lab.DENOISING):
    """Return how many pucks a planner brings home."""
    return np.sum(lab.episodes_of(planner, steps).home())


def two_draws(planner):
    """Return the fraction of starts whose two plans go to different sides."""
    rng = np.random.default_rng(lab.SEED)
    one, two = (lab.sideways(planner, rng) > 0 for _ in range(2))
    return np.mean(one != two)


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"abar at the noisy end, linear schedule": "0.366",
            "width / sigma after 10 DDIM steps": "0.612",
            "width / sigma after 10 Euler steps": "0.617"}  # fmt: skip
    return printed_by(lab, told)


# What a student's run tells in a second.


def test_the_schedules_on_paper():
    assert lab.cosine_schedule(1) == pytest.approx([0.001])
    beta = np.linspace(1e-4, 0.02, 100)
    assert f"The mean of $\\beta$ is {beta.mean():.5f}" in SENTENCES
    assert f"e^{{-1.005}}$ = {np.exp(-beta.sum()):.3f}" in SENTENCES
    end = diffusion.linear_schedule(100)[-1]
    assert f"The exact product is {end:.3f}" in SENTENCES
    assert f"{diffusion.linear_schedule(1000)[-1]:.5f} is left" in SENTENCES


def test_a_mixture_on_paper():
    variance = 0.36 * 0.01 + 0.64
    assert f"$s^2$ is {variance:.4f}" in SENTENCES
    off = np.array([1.1, -0.1])
    probability = np.exp(-0.5 * off**2 / variance)
    assert (
        f"has the probability {(probability / probability.sum())[1]:.3f}" in SENTENCES
    )
    two = lab.MEANS, 0.1, np.ones(2)
    eps = lab.exact_noise(np.array([[0.5]]), 0.36, *two)[0, 0]
    assert f"and the result is {eps:.3f}" in SENTENCES
    variance = 0.25 * 0.01 + 0.25
    assert f"the variance is {variance:.4f}" in SENTENCES
    assert f"the covariance {0.5 * 0.01 - 0.5:.3f}" in SENTENCES
    off = np.array([1.0, 0.0])
    probability = np.exp(-0.5 * off**2 / variance)
    words = f"at 1 is {(probability / probability.sum())[1]:.3f}"
    assert words in SENTENCES
    velocity = lab.exact_velocity(np.array([[0.5]]), 0.5, *two)[0, 0]
    assert f"and the result is {velocity:.3f}" in SENTENCES


def test_the_steps_on_paper():
    one = np.ones((1, 1))
    assert lab.ddim_step(one, 0.5 * one, 0.36, 0.64) == pytest.approx(1.1)
    alpha = 0.36 / 0.64
    gain = 0.36 * np.sqrt(alpha) / 0.64
    assert f"$\\alpha$ is {alpha:.4f}, the gain is {gain:.4f}" in SENTENCES
    mean, more = (
        lab.ddpm_step(one, 0.5 * one, 0.36, 0.64, noise * one)[0, 0] for noise in (0, 1)
    )
    assert mean == pytest.approx(0.8 + gain * (1 - 0.6))
    assert f"and the mean is {mean:.5f}" in SENTENCES
    assert f"The standard deviation is {more - mean:.4f}" in SENTENCES
    kept = lab.width_kept(np.array([0.36]), 0.1)
    assert f"The result of task 17.7 is {kept:.4f}." in SENTENCES
    assert "the clean sample is 1, and the result is 1.1." in SENTENCES


def right_mode(abars, start=None):
    """Return the fraction of the samples in the right mode."""
    start = lab.quantiles(1000) if start is None else start
    return np.mean(lab.ddim(start, abars, lab.noise_of) > 0)


def noisy_quantiles(abar, n=1000):
    """Return quantiles of the noisy data, by bisection."""
    deviation = np.sqrt(abar * lab.SIGMA**2 + 1 - abar)
    low, high = np.full(n, -6.0), np.full(n, 6.0)
    wanted = (np.arange(n) + 0.5) / n
    cdf = np.vectorize(NORMAL.cdf)
    for _ in range(40):
        x = (low + high) / 2
        parts = [cdf((x - np.sqrt(abar) * m) / deviation) for [m] in lab.MEANS]
        below = lab.WEIGHTS @ parts < wanted
        low, high = np.where(below, x, low), np.where(below, high, x)
    return x[:, None]


def test_the_fraction_is_decided_by_the_start():
    abars = diffusion.linear_schedule(100)[::-1]
    assert f"{lab.predicted_fraction(abars[0]):.4f}" == "0.6003"
    assert SENTENCES.count("0.6003") == 1
    assert right_mode(abars) == pytest.approx(0.6003, abs=0.002)
    centre, deviation = np.sqrt(abars[0]), np.sqrt(abars[0] * 0.01 + 1 - abars[0])
    words = f"{-centre:.3f} and {centre:.3f} and the standard deviation {deviation:.3f}"
    assert words in SENTENCES
    at = NORMAL.inv_cdf(1 - lab.predicted_fraction(abars[0]))
    assert f"$x^\\ast$ = {at:.3f}" in SENTENCES
    # The cause is changed: other starts, or a schedule that ends in noise.
    better = right_mode(abars, noisy_quantiles(abars[0]))
    assert f"puts {better:.2f} of the samples into the right-hand mode" in SENTENCES
    strong = diffusion.linear_schedule(100, 1e-3, 0.2)[::-1]
    assert f"$\\bar\\alpha$ is {strong[0]:.5f} at the noisy end" in SENTENCES
    assert f"and the fraction is {right_mode(strong):.2f}" in SENTENCES


def test_the_paths_of_samples_do_not_cross():
    abars = diffusion.linear_schedule(100)[::-1]
    x = lab.ddim(lab.quantiles(1000), abars, lab.noise_of)
    assert (np.diff(x[:, 0]) > 0).all()


def test_the_widths_on_paper():
    steps = lab.cosine_schedule(100)[lab.timesteps(100, 10)]
    assert lab.width_kept(steps, 0.1) == pytest.approx(0.612, abs=5e-4)
    assert (
        f"is {0.1 * lab.euler_width(10):.4f}, so {lab.euler_width(10):.3f}" in SENTENCES
    )
    assert lab.euler_width(1) == 0
    lost = [1 - lab.euler_width(n) for n in (100, 440)]
    assert (
        f"With 100 Euler steps, {100 * lost[0]:.1f} % of the width is lost" in SENTENCES
    )
    assert lost[1] == pytest.approx(0.01, abs=2e-4)
    kept = f"the fraction $(\\cos 9^\\circ)^{{10}}$ = {np.cos(np.pi / 20) ** 10:.3f} of"
    assert kept in SENTENCES
    angle = np.arctan2(np.sqrt(1 - steps), 0.1 * np.sqrt(steps))
    assert angle[0] == pytest.approx(np.pi / 2, abs=1e-4)
    turn = -np.diff(angle)
    assert lab.timesteps(100, 10)[-2:].tolist() == [11, 0]
    words = f"{np.degrees(turn[-1]):.0f} degrees and keeps only {np.cos(turn[-1]):.2f}"
    assert f"has an angle of {words}" in SENTENCES
    before, last = np.prod(np.cos(turn[:-1])), np.cos(angle[-1])
    assert f"{before:.2f}" == f"{last:.2f}"
    assert f"steps before this step keep {before:.2f}, and so does the" in SENTENCES
    noise = np.sqrt(1 - steps) / np.sqrt(steps)
    assert noise[-2] > lab.SIGMA > noise[-1]


def test_the_width_of_two_modes_contains_the_samples_between_them():
    abars = lab.cosine_schedule(100)[lab.timesteps(100, 10)]
    x = lab.ddim(lab.quantiles(lab.SAMPLES), abars, lab.noise_of)
    off = np.median(np.abs(x - lab.MEANS.T).min(axis=1))
    width = off / NORMAL.inv_cdf(0.75) / lab.SIGMA
    assert f"for a Gaussian of width ${width:.2f} \\sigma$" in SENTENCES


def test_flow_matching_and_diffusion_share_their_samples():
    t, x = 0.3, np.array([[0.4], [-0.7]])
    size = np.hypot(t, 1 - t)
    eps = lab.exact_noise(x / size, (t / size) ** 2, *lab.ONE)
    velocity = lab.exact_velocity(x, t, *lab.ONE)
    assert velocity == pytest.approx((x - (1 - t) * eps) / t - eps)


def test_each_kind_of_input_hides_what_the_guide_says():
    x = np.array([[0.3], [-0.8]])
    equal = lab.exact_noise(x, 0.5, lab.MEANS, 0.1, np.ones(2))
    assert equal == pytest.approx(
        lab.exact_noise(x, 0.5, lab.MEANS, 0.1, np.full(2, 5))
    )
    point = lab.exact_noise(x, 0.5, lab.MEANS, 0.0, lab.WEIGHTS)
    right = x - np.sqrt(0.5) * lab.MEANS.T
    prob = lab.WEIGHTS * np.exp(-0.5 * right**2 / 0.5)  # with the variance 1 - abar
    prob = prob / prob.sum(axis=1, keepdims=True)
    assert point[:, 0] == pytest.approx(np.sum(prob * right, axis=1) / np.sqrt(0.5))


def test_the_opening_is_what_the_lab_prints(printed):
    assert re.search(r"linear +0\.60\d +(0\.99|1\.00)\d +0\.000", printed)
    assert "puts" not in printed
    far = re.search(r"DDIM, 5 steps.* (\d\.\d+)\n", printed)[1]
    assert round(100 * float(far)) == 8
    assert "8 % of the samples are far from both modes" in SENTENCES
    error = np.sqrt(0.3 * 0.7 / lab.SAMPLES)
    assert f"a sampling error, {error:.2f} for the fraction" in SENTENCES
    assert f"starts its {lab.SAMPLES} samples" in SENTENCES


def test_the_policy_is_about_as_good_as_the_guide_says(printed):
    counts = [int(n) for n in re.findall(r"about +(\d+) of 200", printed)]
    assert counts == pytest.approx([115, 175, 190], abs=10)
    fraction = float(re.search(r"both sides: (\d\.\d+)", printed)[1])
    assert fraction == pytest.approx(0.40, abs=0.05)
    assert "correct | 0.030 | about 190, 190, 185 | 0.40, 0.36, 0.32" in SENTENCES


def test_no_demonstration_hesitates():
    episodes = push.dock_demonstrations(lab.DEMOS, lab.SEED)
    first = episodes.action[:, : lab.EXECUTED].mean(axis=1)
    ahead = episodes.observation[:, 0, 2:]
    ahead = ahead / np.linalg.norm(ahead, axis=1, keepdims=True)
    slow = np.abs(ahead[:, 0] * first[:, 1] - ahead[:, 1] * first[:, 0]).min()
    assert 0.052 < slow < 0.06
    assert lab.SLOW < 0.052
    assert "faster than 52 mm/s" in SENTENCES


# What only an author can break.


def noise_forgotten(x, eps, abar, prev):
    """Return a step that puts no noise back."""
    return np.sqrt(prev) * (x - np.sqrt(1 - abar) * eps) / np.sqrt(abar)


def multiples(T, n):
    """Return the levels without the noisiest one."""
    return (np.arange(n) * (T // n))[::-1]


@pytest.mark.kit
@pytest.mark.parametrize(
    ("change", "came", "two"),
    [({"ddim_step": noise_forgotten}, 195, 0.0), ({"timesteps": multiples}, 190, 0.41)],
)
def test_the_robot_does_not_show_a_wrong_sampler(change, came, two):
    planner, _ = trained()
    left = lab.cosine_schedule(lab.PLAN_LEVELS)[multiples(lab.PLAN_LEVELS, 10)[0]]
    assert f"At level 45 only {left:.3f} of the power" in SENTENCES
    with changed(**change):
        assert home(planner) == pytest.approx(came, abs=8)
        assert two_draws(planner) == pytest.approx(two, abs=0.05)


@pytest.mark.kit
def test_the_linear_schedule_halves_the_loss_and_brings_no_puck_home():
    planner, loss = trained(schedule=diffusion.linear_schedule)
    assert loss == pytest.approx(0.015, abs=0.002)
    assert trained()[1] == pytest.approx(0.030, abs=0.003)
    with changed(cosine_schedule=diffusion.linear_schedule):
        assert home(planner) <= 2
    end = diffusion.linear_schedule(lab.PLAN_LEVELS)[-1]
    assert f"$\\bar\\alpha$ is {end:.2f} at the noisy end" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize(
    ("method", "plan", "loss", "came"),
    [("diffusion", False, 0.14, 5), ("flow", True, 0.03, 175),
     ("flow", False, 0.30, 80)],
)  # fmt: skip
def test_the_target_decides(method, plan, loss, came):
    planner, found = trained(method, plan)
    assert found == pytest.approx(loss, rel=0.12)
    with changed(METHOD=method, PREDICTS_PLAN=plan):
        assert home(planner) == pytest.approx(came, abs=10 if came > 5 else 3)
    assert re.search(rf"{method} \| the \w+ \| {loss:.2f} \| .*{came},", SENTENCES)


def errors_of_plans(method, plan, keep, lose):
    """Return the mean squared error of the plans of a network at a level."""
    planner, _ = trained(method, plan)
    z = cloning.normalise(rows()[0], planner.seen)
    x0 = cloning.normalise(rows()[1], planner.plans)
    noise = np.random.default_rng(9).normal(size=x0.shape)
    x = keep * x0 + lose * noise
    with changed(METHOD=method, PREDICTS_PLAN=plan):
        if method == "flow":
            return np.mean((x + lose * planner.velocity(z, x, keep) - x0) ** 2)
        eps = planner.noise(z, x, keep**2)
    return np.mean(((x - lose * eps) / keep - x0) ** 2)


@pytest.mark.kit
def test_an_error_of_the_noise_grows_with_the_noise():
    abars = lab.cosine_schedule(lab.PLAN_LEVELS)
    assert 0.9e6 < (1 - abars[-1]) / abars[-1] < 1.1e6
    off = [
        [errors_of_plans("diffusion", plan, np.sqrt(a), np.sqrt(1 - a))
         for plan in (True, False)]
        for a in abars[[25, 3]]
    ]  # fmt: skip
    assert [f"{a:.2f}" for a in abars[[25, 3]]] == ["0.46", "0.98"]
    assert off[0] == pytest.approx([0.02, 0.11], rel=0.15)
    assert off[1][1] < off[1][0]
    off = [errors_of_plans("flow", plan, 0.0, 1.0) for plan in (True, False)]
    assert off == pytest.approx([0.08, 0.26], rel=0.1)


@pytest.mark.kit
def test_roots_that_are_forgotten_in_the_training_cost_few_pucks():
    def wrong(x0, noise, abar):
        return abar[:, None] * x0 + (1 - abar[:, None]) * noise

    with changed(add_noise=wrong):
        planner, _ = lab.train(SILENT, *rows())
    assert home(planner) == pytest.approx(185, abs=8)


@pytest.mark.kit
def test_a_plan_of_one_step_is_the_mean_of_both_sides():
    planner, _ = trained()
    slow = [
        np.mean(np.abs(lab.sideways(planner, np.random.default_rng(1), n)) < lab.SLOW)
        for n in (1, 10)
    ]
    assert slow[0] > 0.85
    assert 0.2 < slow[1] < 0.45

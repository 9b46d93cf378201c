"""Day 16: the numbers in the guide's sentences, and every reason in it."""

import contextlib
import re
from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.lesson.day import find_day
from robo47 import chunking, cloning

import day15_mujoco

DAY = find_day(16)
SENTENCES = sentences(16)
lab = load_script(ROOT / "w3-learning/src/day16_chunking.py")
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))
ABOUT = 8  # runs of 100 that a count may differ by on another machine


@cache
def paused(seed, name):
    """Return the plan of a network that learned the pause."""
    episodes = day15_mujoco.dock_demonstrations(
        lab.DEMOS, seed, coin=False, wait=lab.WAIT
    )
    data = lab.Data(episodes, lab.PAUSE_K)
    with patch.object(lab, "SEED", seed):
        loss = {"squared": lab.masked_l2, "absolute": lab.masked_l1}[name]
        net = lab.train_chunks(SILENT, "", data, loss)
    return lambda seen: data.plan(cloning.normalise(seen, data.inputs), net)


@cache
def latent(seed=1, **change):
    """Return encoder and decoder of a seed, trained with other names in the lab."""
    episodes = day15_mujoco.dock_demonstrations(lab.DEMOS, seed)
    with patch.multiple(lab, SEED=seed, **change):
        return lab.Latent(SILENT, lab.Data(episodes, lab.K))


def divergences(model):
    """Return the KL divergence at the dock and elsewhere, nats."""
    kl = chunking.kl_to_prior(*model.encode())[:, 0]
    first = model.data.first
    return kl[first].mean(), kl[~first].mean()


def second_moment(model):
    """Return the mean of mu^2 + variance at the dock."""
    mu, logvar = model.encode()
    return np.mean((mu**2 + np.exp(logvar))[model.data.first])


def home(plan, h=lab.H, wait=0):
    """Return how many runs succeed with h actions per chunk."""
    return np.sum(lab.episodes_of(chunking.chunked_policy(plan, h), wait).home())


def row(start):
    """Return the cells of a row of a table of the guide."""
    lines = (DAY.folder / DAY.guide).read_text("utf-8").splitlines()
    (found,) = [line for line in lines if line.startswith(f"| {start} |")]
    return found.split("|")[2:-1]


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"squared error: speed of the third entry": "0.33",
            "KL divergence at the dock, nats": "0.693",
            "noise left by the mean of 8 plans": "0.354"}  # fmt: skip
    return printed_by(lab, told)


# What a student's run tells in a few seconds.


def test_the_cases_on_paper_are_what_the_functions_say():
    share = lab.started_share(8, 4)
    assert share[2] == pytest.approx(3 / 9)
    assert "The mean is 0.33 of the full speed" in SENTENCES
    (kl,) = lab.kl_to_prior(np.zeros(1), np.log([4.0]))
    assert f"$\\lambda$ = ln 4 it is {kl:.3f}" in SENTENCES
    assert f"ln 2 = {np.log(2):.3f} nats" in SENTENCES
    assert f"ln 4 = {np.log(4):.3f} nats" in SENTENCES
    assert f"{1 / np.sqrt(8):.3f}." in SENTENCES
    assert lab.ensemble_noise(8, lab.DECAY) == pytest.approx(0.354, abs=5e-4)
    assert lab.ensemble_noise(4, 0.0) == 0.5
    speed, R = day15_mujoco.DOCK_PUSH, day15_mujoco.R
    grown = [np.exp(0.1 * n * speed / R) for n in (8, 12)]
    words = f"by a factor of {grown[0]:.1f} in 8 steps and of {grown[1]:.1f} in 12"
    assert words in SENTENCES


def test_the_mean_is_below_the_median_rule_where_the_guide_says():
    share = lab.started_share(4, 4)  # of question 1
    assert share.tolist() == pytest.approx([0.2, 0.4, 0.6, 0.8])
    assert "In 2 of 5 rows the motion has started by the second entry" in SENTENCES


@pytest.mark.kit
def test_the_opening_is_what_the_lab_prints(printed):
    counts = [int(n) for n in re.findall(r"about +(\d+) of 100", printed)]
    assert counts == pytest.approx([95, 100, 100, 45, 75, 100, 85, 85, 75, 85], abs=8)
    assert "about 45 of 100" in SENTENCES
    assert "about 100 of 100" in SENTENCES
    kl = re.search(r"(\S+) nats at the dock, (\S+) elsewhere", printed)
    assert float(kl[1]) == pytest.approx(0.9, abs=0.1)
    assert "8 % of the entries are padding" in printed


def test_noise_0_hides_what_the_answer_says():
    mu, dz = np.ones((2, 3, 1))
    zero = 0 * mu
    one = lab.encoder_gradient(dz, mu, zero, zero, 0.5)
    assert not one[1].any()
    assert "With $\\epsilon$ = 0 the first part vanishes" in SENTENCES


def test_the_test_of_a_negative_divergence_shows_each_wrong_sign():
    mu, logvar = 2.0, -1.0
    right = lab.kl_to_prior(np.array([[mu]]), np.array([[logvar]])).item()
    assert f"mu = 2 and logvar = -1, which must give {right:.3f}" in SENTENCES
    for of_mu, of_logvar in ((-1, 1), (1, -1), (-1, -1)):
        wrong = (np.exp(logvar) + of_mu * mu**2 - 1 - of_logvar * logvar) / 2
        assert abs(wrong - right) > 0.5


def test_the_test_of_the_rows_shows_a_divergence_that_is_not_divided():
    def gradients(function):
        one = np.ones((1, 1))
        two = np.ones((2, 1))
        return (function(0 * n, n, -n, n, 0.5) for n in (one, two))

    for one, two in zip(*gradients(lab.encoder_gradient), strict=True):
        assert two == pytest.approx(np.full((2, 1), one.item() / 2))
    for one, two in zip(*gradients(not_divided), strict=True):
        assert two == pytest.approx(np.full((2, 1), one.item()))
    assert "the gradient of each row must be half as large" in SENTENCES


def test_plans_in_the_wrong_order_act_as_the_negative_decay():
    plans = np.random.default_rng(0).normal(size=(4, 4, 2))
    weight = np.exp(-np.arange(4.0))[::-1]  # the newest has the largest weight
    now = np.array([plans[i, 3 - i] for i in range(4)])
    wrong = weight @ now / weight.sum()
    assert lab.temporal_ensemble(plans, -1.0) == pytest.approx(wrong)
    assert "the decay 1 has this effect too" in SENTENCES


# What only an author can break.


@pytest.mark.kit
@pytest.mark.parametrize(
    ("name", "seed"), [("squared", 1), ("absolute", 1), ("absolute", 2)]
)
def test_the_table_of_actions_per_chunk(name, seed):
    counts = [int(n) for n in row(f"{name} error, seed {seed}")]
    plan = paused(seed, name)
    found = [home(plan, h, lab.WAIT) for h in (1, 2, 3, 4, 6, 8, 12)]
    assert found == pytest.approx(counts, abs=ABOUT)


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_start_that_is_not_slow_succeeds(seed):
    plan = paused(seed, "absolute")
    chunk = chunking.chunked_policy(plan, lab.PAUSE_K)
    steps = iter(range(1000))

    def six_at_first(seen):
        return chunk(seen) if next(steps) < 6 else plan(seen)[:, 0]

    came = np.sum(lab.episodes_of(six_at_first, lab.WAIT).home())
    assert came == pytest.approx((99, 100, 98)[seed - 1], abs=3)
    assert home(plan, 1, lab.WAIT) == pytest.approx((43, 60, 38)[seed - 1], abs=ABOUT)
    assert "99, 100 and 98 of 100 runs succeed for three seeds" in SENTENCES
    assert "Without this change 43, 60 and 38 runs succeed" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize(
    ("beta", "seed", "dock", "elsewhere", "came"),
    [
        (0.01, 1, 3.0, 2.6, 0),
        (0.03, 1, 1.7, 0.9, 5),
        (0.1, 1, 0.9, 0.1, 85),
        (0.1, 2, 1.0, 0.1, 80),
        (0.3, 1, 0.01, 0.0, 90),
        (1.0, 1, 0.0, 0.0, 90),
    ],
)
def test_the_table_of_beta(beta, seed, dock, elsewhere, came):
    model = latent(seed, BETA=beta)
    assert divergences(model) == pytest.approx([dock, elsewhere], rel=0.1, abs=0.06)
    assert home(model.with_z()) == pytest.approx(came, abs=ABOUT)
    at_dock, other, runs = (cell.split(",")[seed - 1] for cell in row(f"{beta:g}"))
    assert float(at_dock) == pytest.approx(dock, abs=0.05)
    assert float(other) == elsewhere
    assert float(runs.replace("about", "")) == came


@pytest.mark.kit
def test_a_dead_z_does_not_turn_the_side_and_a_live_one_does():
    for beta, share in ((0.1, 0.95), (0.3, 0.11)):
        model = latent(1, BETA=beta)
        differ = np.mean(lab.sides(model, -1.5) != lab.sides(model, 1.5))
        assert differ == pytest.approx(share, abs=0.04)
    assert "the side changes in 11 % of the starts" in SENTENCES
    assert "the other side of the puck for 95 % of the starts" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize(("beta", "std", "came"), [(0.01, 1.0, 0), (0.1, 0.4, 100)])
def test_a_cheap_z_changes_along_an_episode(beta, std, came):
    model = latent(1, BETA=beta)
    mu = model.encode()[0].reshape(lab.DEMOS, day15_mujoco.STEPS)
    assert np.median(mu[:, 1:].std(axis=1)) == pytest.approx(std, abs=0.05)
    start = day15_mujoco.dock_demonstrations(lab.DEMOS, 1).observation[:, 0]
    policy = chunking.chunked_policy(lambda seen: model.plan(seen, mu[:, :1]), lab.H)
    run = day15_mujoco.run(*day15_mujoco.scene(), start, policy)
    assert np.sum(run.home()) == pytest.approx(came, abs=2)
    assert (
        "standard deviation of 1.0, compared with 0.4 for $\\beta$ = 0.1" in SENTENCES
    )
    assert "no run succeeds. With $\\beta$ = 0.1, all 100 runs succeed" in SENTENCES


def by_variance(mu, logvar, noise):
    """Return samples with the variance in place of the standard deviation."""
    return mu + np.exp(logvar) * noise


def without_noise(dz, mu, logvar, noise, beta):
    """Return the gradient with a noise of 1 for logvar."""
    dmu, _ = chunking.encoder_gradient(dz, mu, logvar, noise, beta)
    return dmu, chunking.encoder_gradient(dz, mu, logvar, 1 + 0 * noise, beta)[1]


def not_divided(dz, mu, logvar, noise, beta):
    """Return the gradient with the sum of the divergences."""
    return chunking.encoder_gradient(dz, mu, logvar, noise, beta * len(mu))


GRADIENT = lab.Latent.gradient


def one_sample(self, rows, both, noise):
    """Return the gradient with one sample for all rows."""
    return GRADIENT(self, rows, both, 0 * noise + noise[0])


@pytest.mark.kit
@pytest.mark.parametrize(
    ("start", "change"),
    [
        ("correct", {}),
        ("1. variance", {"reparameterise": by_variance}),
        ("2. noise missing", {"encoder_gradient": without_noise}),
        ("3. not divided", {"encoder_gradient": not_divided}),
        ("4. one sample", None),
    ],
)
def test_no_success_rate_shows_a_mistake(start, change):
    patched = patch.object(lab.Latent, "gradient", one_sample)
    with patched if change is None else contextlib.nullcontext():
        model = latent.__wrapped__(1, **change or {})
    found = home(model.with_z()), divergences(model)[0], second_moment(model)
    cells = [float(one.split(",")[0].replace("about", "")) for one in row(start)]
    assert found[0] == pytest.approx(cells[0], abs=ABOUT)
    assert found[1:] == pytest.approx(cells[1:], abs=0.11)
    assert "with `noise = 0 noise + noise[0]`" in SENTENCES  # one_sample, no stars


def across(action, episode, K):
    """Return chunks that continue in the next episode."""
    return chunking.action_chunks(action, 0 * episode, K)


def by_all(pred, target, mask):
    """Return the loss divided by all entries."""
    error = (pred - target) * mask[:, :, None]
    return np.abs(error).sum() / error.size, np.sign(error) / error.size


def test_a_loss_by_all_entries_is_too_small_by_the_padding():
    pred, target = np.random.default_rng(0).normal(size=(2, 5, 3, 2))
    mask = np.arange(5)[:, None] + np.arange(3) < 5
    right, wrong = (f(pred, target, 1.0 * mask) for f in (lab.masked_l1, by_all))
    for one, other in zip(right, wrong, strict=True):
        assert other == pytest.approx(one * mask.mean())
    assert "are too small by the fraction of padding" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize("change", [{"action_chunks": across}, {"masked_l1": by_all}])
def test_the_robot_does_not_show_wrong_padding(change):
    assert home(latent(1, **change).with_z()) == pytest.approx(85, abs=ABOUT)
    assert "about 85 of 100 runs succeed with the mistake" in SENTENCES
    assert "for two seeds, about 85 and 80 of 100 runs succeed, as many" in SENTENCES


@pytest.mark.kit
def test_the_noise_that_is_left_is_that_of_entries_of_different_sizes():
    plan = latent().with_z()
    seen = lab.episodes_of(chunking.chunked_policy(plan, lab.H)).observation
    rng = np.random.default_rng(1)
    errors = []
    for now in seen[:, :-1].transpose(1, 0, 2):
        errors.append(plan(now + lab.NOISE * rng.normal(size=now.shape)) - plan(now))
    s = np.std(errors, axis=(0, 1, 3))
    assert s[7] / s[0] == pytest.approx(0.47, abs=0.03)
    assert "only 47 % of the error in the first entry" in SENTENCES
    predicted = np.sqrt(np.sum(s**2)) / (8 * s[0])
    assert predicted == pytest.approx(0.27, abs=0.01)
    assert lab.noise_left(latent(), rng) == pytest.approx(predicted, abs=0.02)
    assert "/ (8 s_0)$ gives 0.27" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 2])
def test_the_mean_of_both_sides_is_worse_than_the_median(seed):
    data = lab.Data(day15_mujoco.dock_demonstrations(lab.DEMOS, seed), lab.K)
    came = []
    for loss in (lab.masked_l1, lab.masked_l2):
        with patch.object(lab, "SEED", seed):
            net = lab.train_chunks(SILENT, "", data, loss)

        def plan(seen, net=net):
            return data.plan(cloning.normalise(seen, data.inputs), net)

        came.append(home(plan))
    assert came == pytest.approx([(85, 60), (90, 65)][seed - 1], abs=ABOUT)
    assert "in about 85 and 90 of 100 runs with the absolute error" in SENTENCES
    assert "about 60 and 65 with the squared error" in SENTENCES


@pytest.mark.kit
def test_a_larger_decay_executes_older_plans():
    came = []
    for decay in (0.3, 1.0):
        policy = chunking.ensembled_policy(latent().with_z(), lab.K, decay)
        came.append(np.sum(lab.episodes_of(policy).home()))
    assert came == pytest.approx([35, 10], abs=ABOUT)
    assert "about 35 and 10 of 100 runs succeed" in SENTENCES


@pytest.mark.kit
def test_half_the_price_makes_up_for_a_chunk_twice_as_long():
    dear, _ = divergences(latent(1, K=16))
    cheap, _ = divergences(latent(1, K=16, BETA=0.05))
    assert dear < np.log(2) < 1.3 < cheap

"""Day 20: the numbers in the guide's sentences, and every reason in it."""

import re
from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.check.tasks import check_tasks
from labkit.lesson.day import find_day
from labkit.sandbox.sandbox import Sandbox
from robo47 import optimal, reward

import day15_mujoco

SENTENCES = sentences(20)
lab = load_script(ROOT / "w3-learning/src/day20_reward.py")
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))


def rest(T=lab.HORIZON, std=lab.STD):
    """Return what follows K in the exact cost."""
    return std, lab.A, lab.B, lab.Q, lab.R, lab.START, T


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {
        "variance of one step, baseline: mean reward": "5.52",
        "variance of one step, baseline: best": "4.88",
        "half the value, lambda 0.5: first entry": "3",
        "pucks apart, with feedback, mm": "1",
        "pucks apart, replayed, mm": "10",
    }
    return printed_by(lab, told)


@cache
def estimates():
    """Return mean, standard errors and standard deviation by estimator."""
    cart = lab.Cart(np.random.default_rng(lab.SEED), lab.BATCHES * lab.EACH)
    truth = -lab.policy_cost_gradient(lab.GAIN, *rest())[0]
    found = {}
    for name, weight in lab.weights_of(cart).items():
        some = cart.estimates(weight)
        each = some.std(axis=0, ddof=1)
        off = (some.mean(axis=0) - truth) / each * np.sqrt(len(some))
        found[name] = some.mean(axis=0), off, np.linalg.norm(each)
    return found


# What a student's run tells in seconds.


def test_the_opening_is_what_the_lab_prints(printed):
    std = [found[2] for found in estimates().values()]
    for value, digits in zip(std[:3], ("40.4", "20.9", "1.52"), strict=True):
        assert f"{value:.{len(digits.split('.')[1])}f}" == digits
        assert re.search(rf"\b{digits} if", SENTENCES)
        assert re.search(rf" {value:.2f}$", printed, re.M)
    length = np.linalg.norm(lab.policy_cost_gradient(lab.GAIN, *rest()))
    assert f"The norm of the exact gradient is {length:.1f}" in SENTENCES
    assert f"about {round((std[0] / std[2]) ** 2, -2):.0f} times as many" in SENTENCES


def test_the_first_six_estimators_are_right_and_the_last_two_are_not():
    off = [np.abs(found[1]).max() for found in estimates().values()]
    assert max(off[:6]) < 2.5
    assert f"from the exact gradient by {off[6]:.0f} standard errors" in SENTENCES
    assert min(off[6:]) > 20


def test_the_pucks_of_the_lab(printed):
    counts = [int(n) for n in re.findall(r"about +(\d+) of 200", printed)]
    assert counts == pytest.approx([110, 130], abs=10)
    assert "the clone brings home about 110 of 200 pucks" in SENTENCES
    assert "| right | about 130 |" in SENTENCES
    episodes = lab.ITERATIONS * lab.EPISODES
    assert f"PPO runs {episodes} episodes" in SENTENCES
    assert f"practised for {episodes} episodes" in SENTENCES


def test_the_cases_on_paper_are_what_the_functions_return():
    one = np.ones((1, 1))
    values = lab.log_prob(one, 0 * one, np.log([2.0]))[0]
    assert f"log-probability is {values:.3f}" in SENTENCES
    some = (one,) * 5
    assert lab.policy_cost_gradient(one / 2, 1.0, *some, 2)[0, 0] == 1
    assert lab.policy_cost_gradient(one / 2, 0.0, *some, 2)[0, 0] == 0
    assert "With $\\sigma = 1$ it is 1" in SENTENCES
    # K = 0.5 is the optimal gain.
    _, K = optimal.riccati_step(one, one, one, one, one)
    assert K[0, 0] == 0.5


def test_the_variances_of_one_step_on_paper():
    d, s = lab.MU - lab.TARGET, lab.NOISE
    for b, wanted, words in (
        (
            0.0,
            d**4 / s**2 + 14 * d**2 + 15 * s**2,
            "Without a baseline the variance is",
        ),
        (-(d**2) - s**2, 8 * d**2 + 10 * s**2, "3.92 + 1.60 ="),
        (-(d**2) - 3 * s**2, 8 * d**2 + 6 * s**2, "3.92 + 0.96 ="),
    ):
        assert lab.one_step_variance(d, b) == pytest.approx(wanted)
        assert f"{words} {wanted:.2f}" in SENTENCES
    assert "variance $8 d^2 + (k^2 - 6 k + 15) \\sigma^2$" in SENTENCES
    for k in (0, 1, 2.5, 3, 7):
        wanted = 8 * d**2 + (k**2 - 6 * k + 15) * s**2
        assert lab.one_step_variance(d, -(d**2) - k * s**2) == pytest.approx(wanted)
    bs = np.linspace(-3, 1, 401)
    best = bs[np.argmin([lab.one_step_variance(d, b) for b in bs])]
    assert best == pytest.approx(-(d**2) - 3 * s**2, abs=0.01)


def test_descent_ends_at_riccatis_gain_if_the_horizon_is_long():
    P = lab.Q
    for _ in range(300):
        P, best = optimal.riccati_step(P, lab.A, lab.B, lab.Q, lab.R)

    def end(T, size, steps):
        K = lab.GAIN
        for _ in range(steps):
            K = K - size * lab.policy_cost_gradient(K, *rest(T))
        return K

    short = end(lab.HORIZON, lab.STEP_SIZE, lab.DESCENT)
    assert (short < best).all()
    assert "a slightly smaller gain is cheaper" in SENTENCES
    long = end(240, 0.05, 150)
    assert np.abs(long - best).max() < 0.5 * np.abs(short - best).max()


def test_a_mistake_hides_where_the_guide_says():
    rng = np.random.default_rng(0)
    action, mean = rng.normal(size=(2, 9, 2))
    log_std = np.log([0.4, 0.4])
    logp = lab.log_prob(action, mean, log_std) + log_std.sum()  # the term forgotten
    old = lab.log_prob(action, 0.9 * mean, log_std)
    A = rng.normal(size=9)
    right = lab.ppo_loss(logp - log_std.sum(), old, A, 0.2)[1]
    assert lab.ppo_loss(logp, old + log_std.sum(), A, 0.2)[1] == pytest.approx(right)
    # Before the first update the gradient is -A / n, with or without ratio and clip.
    assert lab.ppo_loss(old, old, A, 0.2)[1] == pytest.approx(-A / 9)
    # Where all episodes end together and truly, a cut-off is no case.
    got, value, after = rng.normal(size=(3, 5, 2))
    end = np.zeros((5, 2), dtype=bool)
    end[-1] = True
    for true_end, same in ((end, True), (0 * end, False)):
        right = lab.gae(got, value, after, true_end, end, 0.9, 0.8)
        wrong = lab.gae(got, value, np.where(end, 0, after), true_end, end, 0.9, 0.8)
        assert np.allclose(right, wrong) == same


def test_the_table_of_mistakes_is_counted_right():
    table = SENTENCES.partition("| PPO | pucks home, of 200 |")[2]
    table, _, words = table.partition("With five of the eight mistakes,")
    right, *wrong = (int(n) for n in re.findall(r"\| (?:about )?(\d+) \|", table))
    assert len(wrong) == 8
    assert sum(n >= right for n in wrong) == 5
    assert words.startswith(" the policy brings home at least as many pucks as with")


def test_data_without_a_clip_are_soon_worth_less():
    left, beyond = data_left(CLIP=1e9, ITERATIONS=1)
    assert left == pytest.approx(0.55, abs=0.04)
    assert beyond == pytest.approx(0.70, abs=0.04)
    assert "effective sample size is 55 % after the first iteration" in SENTENCES
    assert "about 70 % of the ratios" in SENTENCES
    left, beyond = data_left(ITERATIONS=1)
    assert left == pytest.approx(0.99, abs=0.01)


# What only an author can break.


@pytest.mark.kit
def test_the_log_of_a_density_that_exp_cannot_represent_does_not_pass(student):
    day = find_day(20)
    code = (ROOT / "w3-learning/src/day20_reward.py").read_text("utf-8")
    density = code.replace("each = -(z**2) / 2", "each = np.log(np.exp(-(z**2) / 2))")
    assert density != code
    path = student(density, day.script)
    with Sandbox() as sandbox:
        results = check_tasks(day, path, sandbox, "20.1", seed=1)
    (verdict,) = [one.verdict for one in results if one.task.id == "20.1"]
    assert verdict.mistake == "underflow"
    assert "not for an action far from the mean" in verdict.message


@cache
def start():
    """Return the starts of the test."""
    return day15_mujoco.starts(lab.TESTED, np.random.default_rng(lab.STARTS_SEED))


def came(**how):
    """Return the pucks that a clone brings home before and after PPO."""
    with patch.multiple(lab, **how):
        policy = lab.clone(SILENT)
        before = lab.tested(policy.act, start())[0].home().sum()
        lab.ppo(SILENT, policy)
        return before, lab.tested(policy.act, start())[0].home().sum()


def data_left(**how):
    """Return the mean fraction of samples that data are worth, and beyond the clip."""
    found = []

    def after(policy, rows):
        x, drawn, old, *_ = rows
        mean = lab.cloning.mlp(x[:, :4], *policy.actor)
        logp = reward.log_prob(drawn, mean, policy.log_std)
        beyond = np.mean(np.abs(np.exp(logp - old) - 1) > 0.2)
        found.append((reward.effective_samples(logp, old) / len(x), beyond))

    with patch.multiple(lab, **how):
        lab.ppo(SILENT, lab.clone(SILENT), after)
    return np.mean(found, axis=0)


@pytest.mark.kit
def test_without_a_clip_the_data_are_worth_44_percent():
    assert data_left(CLIP=1e9)[0] == pytest.approx(0.44, abs=0.06)
    assert "and 44 % on average" in SENTENCES


def loss_with(change):
    """Return a `ppo_loss` whose gradient comes from ratios, limits and advantages."""

    def loss(logp, old_logp, A, clip):
        r = np.exp(logp - old_logp)
        return 0.0, change(r, A, clip) / len(r)

    return loss


def kept(r, A, clip, low=True, least=np.less_equal):
    """Return where the term without clipping counts."""
    limits = np.clip(r, 1 - clip if low else -np.inf, 1 + clip)
    return least(r * A, limits * A)


MISTAKES = {
    "a true end is treated as a cut-off": {
        "gae": lambda r, v, w, end, ended, g, lam: reward.gae(
            r, v, w, 0 * end, ended, g, lam)},
    "`gae` without $\\lambda$": {
        "gae": lambda r, v, w, end, ended, g, lam: reward.gae(
            r, v, w, end, ended, g, 1.0)},
    "the ratio forgotten in the gradient": {
        "ppo_loss": loss_with(lambda r, A, clip: -A * kept(r, A, clip))},
    "ratio clipped above only": {
        "ppo_loss": loss_with(lambda r, A, clip: -r * A * kept(r, A, clip, False))},
    "advantage plus value instead of the advantage": {
        "gae": lambda r, v, *others: reward.gae(r, v, *others) + v},
    "gradient 0 for all ratios outside the range": {
        "ppo_loss": loss_with(lambda r, A, clip: -r * A * (np.abs(r - 1) <= clip))},
    "maximum instead of minimum": {
        "ppo_loss": loss_with(
            lambda r, A, clip: -r * A * kept(r, A, clip, least=np.greater_equal))},
}  # fmt: skip


@pytest.mark.kit
@pytest.mark.parametrize("name", MISTAKES)
def test_what_a_wrong_ppo_brings_home(name):
    row = re.search(rf"\| {re.escape(name)} \| (?:about )?(\d+) \|", SENTENCES)
    assert row, name
    assert came(**MISTAKES[name])[1] == pytest.approx(int(row[1]), abs=12)


@pytest.mark.kit
@pytest.mark.parametrize(
    ("how", "words", "pucks"),
    [
        ({"SHUFFLED": True}, "It brings about 75 pucks home", 75),
        ({"CLIP": 1e9}, "The policy brings about 50 pucks home", 50),
    ],
)
def test_what_a_changed_constant_brings_home(how, words, pucks):
    assert words in SENTENCES
    assert came(**how)[1] == pytest.approx(pucks, abs=12)


@pytest.mark.kit
@pytest.mark.parametrize("seed", [0, 1, 3])
def test_other_seeds_gain_as_well(seed):
    words = "For seeds 0 to 3, the improved policy brings home 19 to 33 more pucks"
    assert words in SENTENCES
    before, after = came(SEED=seed)
    assert 12 <= after - before <= 40

"""Diffusion: schedules, exact denoisers and samplers, against densities and Bayes."""

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st

from robo47 import cloning, diffusion

SEEDS = st.integers(0, 2**32 - 1)
TWO = np.array([[-1.0], [1.0]])


def mixture(rng, k=3, d=2):
    """Return means, sigma and weights of a random mixture."""
    return rng.normal(size=(k, d)), rng.uniform(0.05, 0.5), rng.dirichlet(np.ones(k))


def log_density(x, keep, lose, means, sigma, weights):
    """Return ln p of keep x0 + lose noise, up to a constant, also for a complex x."""
    variance = (keep * sigma) ** 2 + lose**2
    squares = np.sum((x - keep * means) ** 2, axis=-1)
    return np.log(np.sum(weights * np.exp(-0.5 * squares / variance)))


def test_the_worked_cases():
    wanted = [0.847012, 0.493844, 0.144272, 0.000144]
    assert_same(diffusion.cosine_schedule(4), wanted, 1e-6)
    assert_same(diffusion.add_noise([[1]], [[0.5]], [0.36]), [[1.0]], 1e-14)
    eps = diffusion.exact_noise([[0.5]], 0.36, TWO, 0.1, [1, 1])
    assert_same(eps, [[0.297030]], 1e-6)
    assert_same(diffusion.ddim_step([[1]], [[0.5]], 0.36, 0.64), [[1.1]], 1e-14)
    for noise, came in ((0, 0.96875), (1, 1.464828)):
        step = diffusion.ddpm_step([[1]], [[0.5]], 0.36, 0.64, [[noise]])
        assert_same(step, [[came]], 1e-6)
    levels = diffusion.timesteps(50, 10)
    assert levels.tolist() == [49, 44, 38, 33, 27, 22, 16, 11, 5, 0]
    assert diffusion.timesteps(50, 1).tolist() == [49]
    some = diffusion.cosine_schedule(100)[diffusion.timesteps(100, 10)]
    assert diffusion.width_kept(some, 0.1) == pytest.approx(0.611947, abs=1e-6)
    at, velocity = diffusion.flow_pair([[2]], [[1]], [0.25])
    assert_same([at, velocity], [[[1.25]], [[1]]], 0)
    velocity = diffusion.exact_velocity([[0.5]], 0.5, TWO, 0.1, [1, 1])
    assert_same(velocity, [[0.519613]], 1e-6)
    assert_same(diffusion.ema([1.0], [2.0], 0), [1.9], 1e-14)


def test_the_cosine_schedule_is_a_ratio_of_cosines_but_for_its_last_level():
    abar = diffusion.cosine_schedule(50)
    f = np.cos((np.arange(51) / 50 + 0.008) / 1.008 * np.pi / 2) ** 2
    assert_same(abar[:-1], f[1:-1] / f[0], 1e-14)
    assert abar[-1] == pytest.approx(0.001 * abar[-2], rel=1e-12)
    assert (np.diff(abar) < 0).all()
    assert_same(diffusion.cosine_schedule(1), [0.001], 1e-12)


def test_the_linear_schedule_is_made_for_a_thousand_levels():
    assert diffusion.linear_schedule(1000)[-1] == pytest.approx(4e-5, rel=0.02)
    assert diffusion.linear_schedule(100)[-1] == pytest.approx(0.364, abs=5e-4)


@given(SEEDS)
def test_the_exact_noise_is_the_score(seed):
    rng = np.random.default_rng(seed)
    some = mixture(rng)
    abar = rng.uniform(0.05, 0.95)
    keep, lose = np.sqrt(abar), np.sqrt(1 - abar)
    for x in rng.normal(size=(3, 2)):
        [score] = cloning.complex_step(lambda x: log_density(x, keep, lose, *some), [x])
        eps = diffusion.exact_noise(x[None], abar, *some)
        assert_same(eps, -lose * score[None], 1e-10)


@given(SEEDS)
def test_the_exact_velocity_is_the_mean_of_the_posterior(seed):
    rng = np.random.default_rng(seed)
    means, sigma, weights = mixture(rng, 2, 1)
    t, x = rng.uniform(0.1, 0.9), rng.normal()
    x0 = np.linspace(-8, 8, 20_001)
    prior = np.exp(-0.5 * ((x0[:, None] - means.T) / sigma) ** 2) @ weights
    noise = (x - t * x0) / (1 - t)
    posterior = prior * np.exp(-0.5 * noise**2)
    mean = np.sum(posterior * (x0 - noise)) / np.sum(posterior)
    assert_same(
        diffusion.exact_velocity([[x]], t, means, sigma, weights), [[mean]], 1e-9
    )


@given(SEEDS)
def test_noise_and_velocity_are_two_views_of_one_mixture(seed):
    rng = np.random.default_rng(seed)
    some = mixture(rng)
    t, x = rng.uniform(0.05, 0.95), rng.normal(size=(4, 2))
    size = np.hypot(t, 1 - t)
    eps = diffusion.exact_noise(x / size, (t / size) ** 2, *some)
    velocity = (x - (1 - t) * eps) / t - eps
    assert_same(diffusion.exact_velocity(x, t, *some), velocity, 1e-10)


def test_far_samples_and_modes_of_weight_0_have_an_answer():
    far = diffusion.exact_noise([[1e3]], 0.9, TWO, 0.01, [0.0, 1.0])
    right = diffusion.exact_noise([[1e3]], 0.9, TWO[1:], 0.01, [1.0])
    assert_same(far, right, 1e-9)
    same = diffusion.exact_noise([[0.2]], 0.5, TWO, 0.1, [3, 7])
    assert_same(same, diffusion.exact_noise([[0.2]], 0.5, TWO, 0.1, [0.3, 0.7]), 1e-14)


@given(SEEDS)
def test_a_ddim_step_is_a_rotation_of_data_and_noise(seed):
    rng = np.random.default_rng(seed)
    x0, eps = rng.normal(size=(2, 4, 3))
    abar, prev = rng.uniform(0.05, 1, (2, 4))
    x = diffusion.add_noise(x0, eps, abar)
    step = diffusion.ddim_step(x, eps, abar, prev)
    assert_same(step, diffusion.add_noise(x0, eps, prev), 1e-12)


@given(SEEDS)
def test_a_ddpm_step_follows_bayes_rule(seed):
    rng = np.random.default_rng(seed)
    x0, eps = rng.normal(size=(2, 1, 1))
    abar, prev = np.sort(rng.uniform(0.05, 0.95, 2))
    x = diffusion.add_noise(x0, eps, abar)
    alpha = abar / prev
    # x given x_prev, and x_prev given x0: two Gaussians in x_prev.
    precision = alpha / (1 - alpha) + 1 / (1 - prev)
    mean = np.sqrt(alpha) * x / (1 - alpha) + np.sqrt(prev) * x0 / (1 - prev)
    wanted = mean / precision
    steps = [diffusion.ddpm_step(x, eps, abar, prev, [[k]]) for k in (0, 1)]
    assert_same(steps[0], wanted, 1e-11)
    assert_same(steps[1] - steps[0], [[precision**-0.5]], 1e-11)


@pytest.mark.parametrize("n", [1, 2, 5, 50])
def test_the_width_kept_is_what_the_sampler_leaves(n):
    abars = diffusion.cosine_schedule(50)[diffusion.timesteps(50, n)]
    x = start = np.array([[np.sqrt(abars[0] * 0.01 + 1 - abars[0])]])
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        eps = diffusion.exact_noise(x, abar, [[0.0]], 0.1, [1.0])
        x = diffusion.ddim_step(x, eps, abar, prev)
    assert start[0, 0] == pytest.approx(1, abs=1e-5)
    assert x[0, 0] / 0.1 == pytest.approx(diffusion.width_kept(abars, 0.1), rel=1e-12)


def test_the_average_of_parameters_forgets_at_the_given_rate():
    numbers = np.random.default_rng(0).normal(size=(2000, 3))
    slow = numbers[0]
    weights = np.ones(1)
    for k, fast in enumerate(numbers[1:]):
        slow = diffusion.ema(slow, fast, k)
        decay = min(0.995, (1 + k) / (10 + k))
        weights = np.append(decay * weights, 1 - decay)
    assert_same(slow, weights @ numbers, 1e-13)
    assert weights.sum() == pytest.approx(1)


def test_the_features_of_the_levels_differ():
    features = diffusion.time_features(np.arange(50) / 49)
    assert features.shape == (50, 8)
    apart = np.linalg.norm(features[:, None] - features, axis=-1)
    assert apart[~np.eye(50, dtype=bool)].min() > 0.2


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: diffusion.cosine_schedule(0), "T is 0; expected at least 1"),
        (lambda: diffusion.timesteps(5, 6), "at most 5 steps"),
        (lambda: diffusion.ddim_step([[1]], [[1]], 0, 1), "no signal is left"),
        (lambda: diffusion.ddpm_step([[1]], [[1]], 0.5, 0.4, [[0]]), "prev from abar"),
        (lambda: diffusion.add_noise([[1]], [[1]], [1.5]), "abar is 1.5; expected 0"),
        (lambda: diffusion.add_noise([[1]], [[1, 2]], [0.5]), "expected the same"),
        (lambda: diffusion.add_noise([[1]], [[1]], [0.5, 1]), r"expected \(1,\)"),
        (lambda: diffusion.exact_velocity([[0]], 1, TWO, 0, [1, 1]), "above 0"),
        (lambda: diffusion.exact_noise([[0]], 0.5, TWO, 0.1, [0, 0]), "all 0"),
        (lambda: diffusion.exact_noise([[0]], 0.5, TWO, 0.1, [1]), "weights has shape"),
        (lambda: diffusion.ema([0], [0], -1), "k is -1"),
        (lambda: diffusion.width_kept([], 0.1), "abars has shape"),
    ],
)  # fmt: skip
def test_an_argument_that_has_no_answer_is_named(call, says):
    with pytest.raises(ValueError, match=says):
        call()


def test_float32_is_computed_as_float64():
    x = np.array([[0.5]], dtype=np.float32)
    eps = diffusion.exact_noise(x, 0.36, TWO.astype(np.float32), 0.1, [1, 1])
    assert eps.dtype == np.float64

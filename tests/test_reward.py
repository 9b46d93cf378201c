"""Learning from reward against SciPy, the complex step, double sums and Riccati."""

import numpy as np
import pytest
from compare import assert_same
from scipy.stats import multivariate_normal

from robo47 import cloning, optimal, push, reward

ONE = np.ones((1, 1))


def rng():
    return np.random.default_rng(20)


def cart(T=30, std=0.5):
    """Return what follows K: Day 13's cart, its cost, and the start."""
    A, B = np.array([[1.0, 0.1], [0, 1]]), np.array([[0.005], [0.1]])
    return std, A, B, np.eye(2), 0.1 * ONE, np.eye(2), T


def test_the_worked_cases():
    one, log2 = np.ones((1, 1)), np.log([2.0])
    assert reward.log_prob(one, 0 * one, log2)[0] == pytest.approx(-1.737086, abs=5e-7)
    of_mean, of_log_std = reward.log_prob_gradient(one, 0 * one, log2)
    assert (of_mean[0, 0], of_log_std[0, 0]) == pytest.approx((0.25, -0.75))
    column = np.array([[1.0], [2], [3]])
    assert_same(reward.returns(column, 0.5, [4.0]), [[3.25], [4.5], [5]], 0)
    ones, off, cut = np.ones((2, 1)), np.zeros((2, 1), bool), [[False], [True]]
    values = 0.5 * ones, np.array([[0.5], [2]])
    assert_same(reward.gae(ones, *values, off, cut, 0.5, 0.5), [[1.125], [1.5]], 0)
    assert_same(reward.gae(ones, *values, cut, cut, 0.5, 0.5), [[0.875], [0.5]], 0)
    score = np.array([[[1.0]], [[2.0]]])
    assert_same(reward.policy_gradient(score, [[3.0], [1.0]]), [5], 0)
    loss, slope = reward.ppo_loss(np.log([1.5, 0.5]), [0, 0], [1, -1], 0.2)
    assert loss == pytest.approx(-0.2)
    assert_same(slope, [0, 0], 0)
    some = (ONE,) * 5
    assert reward.policy_cost(0.5 * ONE, 0.0, *some, 2) == 1.5625
    assert reward.policy_cost(0.5 * ONE, 1.0, *some, 2) == 4.8125
    assert_same(reward.policy_cost_gradient(0.5 * ONE, 0.0, *some, 2), [[0]], 1e-14)
    assert reward.effective_samples(np.log([3.0, 1.0]), [0, 0]) == pytest.approx(1.6)
    shaped = reward.shaped(np.ones((2, 1)), [[0], [2], [4]], 0.5)
    assert_same(shaped, [[2], [1]], 0)


def test_log_prob_is_scipys_and_its_gradient_the_complex_steps():
    r = rng()
    action, mean, log_std = (
        r.normal(size=(5, 3)),
        r.normal(size=(5, 3)),
        r.normal(size=3),
    )
    wanted = [
        multivariate_normal.logpdf(a, m, np.diag(np.exp(2 * log_std)))
        for a, m in zip(action, mean, strict=True)
    ]
    assert_same(reward.log_prob(action, mean, log_std), wanted, 1e-12)
    of_mean, of_log_std = reward.log_prob_gradient(action, mean, log_std)

    def total(mean, log_std):
        return np.sum(-0.5 * ((action - mean) / np.exp(log_std)) ** 2 - log_std)

    by_mean, by_log_std = cloning.complex_step(total, [mean, log_std])
    assert_same(of_mean, by_mean, 1e-12)
    assert_same(of_log_std.sum(axis=0), by_log_std, 1e-12)


def test_returns_and_advantages_are_sums():
    r = rng()
    got, value, after = r.normal(size=(3, 6, 2))
    end = np.zeros((6, 2), bool)
    end[[1, 4], [0, 1]] = True
    true_end = end.copy()
    true_end[4, 1] = False  # cut off
    gamma, lam = 0.9, 0.7
    delta = got + gamma * np.where(true_end, 0.0, after) - value
    wanted = np.zeros((6, 2))
    for (t, n), _ in np.ndenumerate(delta):
        for k in range(t, 6):
            wanted[t, n] += (gamma * lam) ** (k - t) * delta[k, n]
            if end[k, n]:
                break
    found = reward.gae(got, value, after, true_end, end, gamma, lam)
    assert_same(found, wanted, 1e-14)
    assert_same(
        reward.gae(got, value, after, 1 * true_end, 1 * end, gamma, lam), found, 0
    )
    # With lambda 1 and one episode it is the return minus the value.
    none = np.zeros((6, 2), bool)
    value = np.vstack([value, after[-1:]])
    found = reward.gae(got, value[:-1], value[1:], none, none, gamma, 1.0)
    wanted = reward.returns(got, gamma, value[-1]) - value[:-1]
    assert_same(found, wanted, 1e-14)


def test_ppos_gradient_is_the_complex_steps_on_all_four_sides():
    logp = np.log([1.5, 1.5, 0.5, 0.5, 1.1, 0.9])
    advantage = np.array([1.0, -1, 1, -1, 2, -3])
    _, slope = reward.ppo_loss(logp, np.zeros(6), advantage, 0.2)

    def loss(logp):
        ratio = np.exp(logp)
        clipped = np.where(
            ratio.real > 1.2, 1.2, np.where(ratio.real < 0.8, 0.8, ratio)
        )
        both = ratio * advantage, clipped * advantage
        return -np.mean(np.where(both[0].real <= both[1].real, *both))

    assert_same(slope, cloning.complex_step(loss, [logp])[0], 1e-14)
    assert (slope == 0).tolist() == [True, False, False, True, False, False]


def test_a_ratio_that_overflows_is_no_nan():
    loss, slope = reward.ppo_loss([800.0, 0.0], [0.0, 0.0], [0.0, 1.0], 0.2)
    assert loss == -0.5
    assert_same(slope, [0, -0.5], 0)
    assert reward.effective_samples([2000.0, 2000.0], [0.0, 0.0]) == 2


def test_the_cost_is_what_episodes_cost_on_average():
    std, A, B, Q, R, S, T = cart(T=8)
    K, r, n = np.array([[1.0, 1.5]]), rng(), 40_000
    x, cost = r.normal(size=(n, 2)), np.zeros(n)
    for _ in range(T):
        u = -x @ K.T + std * r.normal(size=(n, 1))
        cost += np.sum(x @ Q * x, axis=1) + np.sum(u @ R * u, axis=1)
        x = x @ A.T + u @ B.T
    wanted = reward.policy_cost(K, std, A, B, Q, R, S, T)
    assert abs(cost.mean() - wanted) < 4 * cost.std() / np.sqrt(n)


def test_its_gradient_is_the_complex_steps_and_0_at_riccatis_gain():
    some = cart()
    K = np.array([[1.0, 1.5]])
    found = reward.policy_cost_gradient(K, *some)
    wanted = cloning.complex_step(lambda K: reward.policy_cost(K, *some), [K])[0]
    assert_same(found / wanted, np.ones((1, 2)), 1e-13)
    _, A, B, Q, R, *_ = some
    P = np.eye(2)
    for _ in range(1000):
        P, K = optimal.riccati_step(P, A, B, Q, R)
    slope = reward.policy_cost_gradient(K, *cart(T=2000))
    assert np.abs(slope).max() / reward.policy_cost(K, *cart(T=2000)) < 1e-2
    assert np.abs(slope).max() < 1e-2 * np.abs(found).max()


def test_the_mean_of_many_estimates_is_the_gradient():
    std, A, B, Q, R, S, T = cart(T=6)
    K, r, n = np.array([[1.0, 1.5]]), rng(), 40_000
    x, scores, rewards = r.normal(size=(n, 2)), [], []
    for _ in range(T):
        mean = -x @ K.T
        u = mean + std * r.normal(size=(n, 1))
        scores.append(-reward.log_prob_gradient(u, mean, np.log([std]))[0] * x)
        rewards.append(-np.sum(x @ Q * x, axis=1) - np.sum(u @ R * u, axis=1))
        x = x @ A.T + u @ B.T
    ahead = reward.returns(rewards, 1.0, np.zeros(n))
    found = reward.policy_gradient(scores, ahead)
    wanted = -reward.policy_cost_gradient(K, std, A, B, Q, R, S, T)[0]
    each = np.einsum("tnd,tn->nd", np.array(scores), ahead)
    assert np.all(np.abs(found - wanted) < 4 * each.std(axis=0) / np.sqrt(n))


def test_shaping_adds_a_sum_that_no_action_changes():
    r, gamma = rng(), 0.9
    got, potential = r.normal(size=(5, 2)), r.normal(size=(6, 2))
    both = [
        reward.returns(one, gamma, np.zeros(2))[0]
        for one in (reward.shaped(got, potential, gamma), got)
    ]
    assert_same(both[0] - both[1], gamma**5 * potential[-1] - potential[0], 1e-14)


def test_the_equation_follows_the_closed_form_of_day_15():
    at = np.array([[-push.R * np.cos(0.3), -push.R * np.sin(0.3), 0, 0]])
    done = at
    for _ in range(4):
        done = reward.push_by_equation(done, np.array([[0.1, 0.0]]), 0.1, push.R)
    dx, dy = done[0, 2:] - done[0, :2]
    wanted = cloning.contact_angle(0.3, 0.04, push.R)
    assert np.arctan2(dy, dx) == pytest.approx(wanted, abs=0.006)
    away = np.array([[0.3, 0.0, 0, 0]])
    moved = reward.push_by_equation(away, np.array([[0.1, 0.1]]), 0.1, push.R)
    assert_same(moved, [[0.31, 0.01, 0, 0]], 1e-14)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: reward.returns([[1.0]], 1.5, [0.0]), "gamma is 1.5"),
        (lambda: reward.returns(np.zeros((0, 2)), 0.9, [0.0, 0.0]), "reward has shape"),
        (lambda: reward.gae(*[[[1.0]]] * 3, [[1]], [[0]], 0.9, 0.9), "terminated"),
        (lambda: reward.gae(*[[[1.0]]] * 3, [[0.5]], [[1]], 0.9, 0.9), "other than"),
        (lambda: reward.gae(*[[[1.0]]] * 3, [1], [[1]], 0.9, 0.9), "expected"),
        (lambda: reward.ppo_loss([0.0], [0.0], [1.0], 0.0), "clip is 0"),
        (lambda: reward.policy_cost(*[ONE] * 1, 1.0, *[ONE] * 5, 0), "T is 0"),
        (lambda: reward.policy_cost(np.ones(2), 1.0, *[ONE] * 5, 1), "K has shape"),
        (lambda: reward.policy_cost(1j * np.ones((2, 1)), 1.0, *[ONE] * 5, 1), "K has"),
    ],
)
def test_bad_arguments_are_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()

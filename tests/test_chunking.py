"""Action chunks, a latent variable, ensembling: exact values and closed forms."""

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import softmax
from scipy.stats import norm

from robo47 import chunking, cloning, push

SEEDS = st.integers(0, 2**32 - 1)


def some_net(rng, a=3, h=5, g=4, m=2):
    """Return the arrays of a net whose layers all differ in size."""
    sizes = ((a, h), (h,), (h, g), (g,), (g, m), (m,))
    return [0.7 * rng.normal(size=size) for size in sizes]


def test_the_worked_cases():
    targets, mask = chunking.action_chunks([[1], [2], [3]], [0, 0, 0], 2)
    assert targets[..., 0].tolist() == [[1, 2], [2, 3], [3, 0]]
    assert mask.tolist() == [[1, 1], [1, 1], [1, 0]]
    pred = np.array([[[1.0], [9]], [[3], [0]]])
    loss, grad = chunking.masked_l1(pred, 0 * pred, [[1, 0], [1, 1]])
    assert loss == pytest.approx(4 / 3)
    assert_same(grad.ravel(), [1 / 3, 0, 1 / 3, 0], 1e-16)
    assert_same(chunking.reparameterise([[1]], [[np.log(4)]], [[0.5]]), [[2]], 1e-14)
    assert_same(
        chunking.kl_to_prior([[1, 0]], [[0, np.log(4)]]), [[0.5, 0.806853]], 1e-6
    )
    both = chunking.encoder_gradient([[2]], [[1]], [[0]], [[0.5]], 0.1)
    assert_same(np.ravel(both), [2.1, 0.5], 1e-14)
    net = [one for w in (2.0, 3.0, 1.0) for one in (np.full((1, 1), w), np.zeros(1))]
    assert_same(chunking.backprop([[0]], [[1]], *net)[-1], [[6]], 0)
    plans = np.arange(6.0).reshape(2, 3, 1)
    assert_same(chunking.temporal_ensemble(plans, np.log(2)), [5 / 3], 1e-14)
    share = chunking.started_share(6, 8)
    assert_same(share, [*np.arange(1, 8) / 7, 1], 1e-16)
    assert chunking.ensemble_noise(8, 0.01) == pytest.approx(0.353646, abs=1e-6)
    found = chunking.attention([[1, 0]], np.eye(2), [[1], [0]])
    assert_same(found, [[0.669762]], 1e-6)


@given(SEEDS)
def test_chunks_are_those_of_a_double_loop(seed):
    rng = np.random.default_rng(seed)
    episode = np.repeat([4, 0, 4, 4], rng.integers(1, 5, 4))  # 4 comes again
    episode[-1] = 9
    n, K = len(episode), int(rng.integers(1, 8))
    action = rng.normal(size=(n, 2))
    targets, mask = chunking.action_chunks(action, episode, K)
    for i in range(n):
        ended = False
        for j in range(K):
            ended |= i + j >= n or episode[i + j] != episode[i]
            assert mask[i, j] == (not ended)
            assert_same(targets[i, j], 0 * action[0] if ended else action[i + j], 0)


@given(SEEDS)
def test_the_gradient_of_the_absolute_error_is_its_difference(seed):
    rng = np.random.default_rng(seed)
    pred, target = rng.normal(size=(2, 3, 4, 2))
    pred += 0.1 * np.sign(pred - target)  # no error is 0
    mask = rng.integers(0, 2, (3, 4))
    mask[0, 0] = 1
    loss, grad = chunking.masked_l1(pred, target, mask)
    there = mask == 1
    assert loss == pytest.approx(np.mean(np.abs(pred - target)[there]))
    for at in np.ndindex(pred.shape):
        more = pred.copy()
        more[at] += 0.01
        change = (chunking.masked_l1(more, target, mask)[0] - loss) / 0.01
        assert grad[at] == pytest.approx(change, abs=1e-12)
    as_bool = chunking.masked_l1(pred, target, mask.astype(bool))
    assert_same(as_bool[1], grad, 0)


@given(st.floats(-2, 2), st.floats(-2, 2))
def test_the_divergence_is_its_integral(mu, logvar):
    std = np.exp(logvar / 2)

    def density(x):
        log = norm.logpdf(x, mu, std)
        return np.exp(log) * (log - norm.logpdf(x))

    wanted = quad(density, mu - 12 * std, mu + 12 * std, epsabs=1e-11, limit=200)[0]
    assert chunking.kl_to_prior(mu, logvar) == pytest.approx(wanted, abs=1e-9)


@given(SEEDS)
def test_the_encoders_gradient_is_that_of_the_complex_step(seed):
    rng = np.random.default_rng(seed)
    mu, logvar, noise, weight = rng.normal(size=(4, 5, 2))

    def loss(mu, logvar):
        z = chunking.reparameterise(mu, logvar, noise)
        divergence = np.sum(chunking.kl_to_prior(mu, logvar), axis=1)
        return np.sum(weight * z**2) + 0.3 * np.mean(divergence)

    dz = 2 * weight * chunking.reparameterise(mu, logvar, noise)
    mine = chunking.encoder_gradient(dz, mu, logvar, noise, 0.3)
    for one, wanted in zip(mine, cloning.complex_step(loss, [mu, logvar]), strict=True):
        assert_same(one, wanted, 1e-13)


@given(SEEDS)
def test_backpropagation_is_that_of_the_complex_step(seed):
    rng = np.random.default_rng(seed)
    net, x = some_net(rng), rng.normal(size=(6, 3))
    weight = rng.normal(size=(6, 2))

    def loss(*arrays):
        *net, x = arrays
        return np.sum(weight * cloning.mlp(x, *net) ** 2)

    d = 2 * weight * cloning.mlp(x, *net)
    wanted = cloning.complex_step(loss, [*net, x])
    for mine, one in zip(chunking.backprop(x, d, *net), wanted, strict=True):
        assert_same(mine, one, 1e-12)


def test_backpropagation_of_a_squared_error_is_day_15s():
    rng = np.random.default_rng(3)
    net, x, target = some_net(rng), rng.normal(size=(6, 3)), rng.normal(size=(6, 2))
    d = cloning.mse(cloning.mlp(x, *net), target)[1]
    mine = chunking.backprop(x, d, *net)[:6]
    for one, wanted in zip(mine, cloning.mlp_gradient(x, target, *net), strict=True):
        assert_same(one, wanted, 0)


def test_what_overflows_is_infinite():
    assert chunking.reparameterise(0.0, 1500.0, 1.0) == np.inf
    assert chunking.kl_to_prior(0.0, 800.0) == np.inf
    dmu, dlogvar = chunking.encoder_gradient([[0.5]], [[1]], [[800]], [[0]], 1.0)
    assert dmu == 1.5
    assert dlogvar == np.inf


@given(SEEDS)
def test_plans_that_agree_are_executed_as_they_are(seed):
    rng = np.random.default_rng(seed)
    path = rng.normal(size=(9, 2))
    plans = np.stack([path[i : i + 5] for i in range(4)])
    decay = rng.normal()
    assert_same(chunking.temporal_ensemble(plans, decay), path[3], 1e-14)


def test_a_large_decay_leaves_one_plan():
    plans = np.random.default_rng(0).normal(size=(3, 4, 2))
    assert_same(chunking.temporal_ensemble(plans, 1e4), plans[0, 2], 0)
    assert_same(chunking.temporal_ensemble(plans, -1e4), plans[2, 0], 0)
    assert chunking.ensemble_noise(5, 1e4) == 1
    assert chunking.ensemble_noise(9, 0.0) == pytest.approx(1 / 3)


def test_the_mean_of_plans_leaves_the_noise_that_is_predicted():
    noise = np.random.default_rng(1).normal(size=(6, 6, 40_000))
    left = chunking.temporal_ensemble(noise, 0.3).std()
    assert left == pytest.approx(chunking.ensemble_noise(6, 0.3), rel=0.01)


@pytest.mark.parametrize(("wait", "K"), [(0, 3), (3, 2), (6, 12)])
def test_the_share_of_chunks_that_have_started_is_counted(wait, K):
    action = np.repeat([0.0, 1.0], [wait, wait + K + 1])[:, None]
    targets, _ = chunking.action_chunks(action, 0 * action[:, 0], K)
    counted = targets[: wait + 1, :, 0].mean(axis=0)  # the rows of the pause
    assert_same(chunking.started_share(wait, K), counted, 1e-14)


@given(SEEDS)
def test_attention_is_a_softmax(seed):
    rng = np.random.default_rng(seed)
    q, k, v = (rng.normal(size=size) for size in ((4, 3), (5, 3), (5, 2)))
    weights = softmax(q @ k.T / np.sqrt(3), axis=1)
    assert_same(chunking.attention(q, k, v), weights @ v, 1e-14)
    assert np.isfinite(chunking.attention(1e4 * q, k, v)).all()


def counting(K):
    """Return a plan that numbers its calls and its entries, and the calls."""
    calls = []

    def plan(seen):
        calls.append(seen)
        chunk = 100.0 * len(calls) + np.arange(K)
        return np.tile(chunk[None, :, None], (len(seen), 1, 2))

    return plan, calls


def test_a_policy_looks_again_after_h_steps():
    plan, calls = counting(4)
    policy = chunking.chunked_policy(plan, 3)
    done = [policy(np.zeros((2, 4)))[1, 0] for _ in range(7)]
    assert done == [100, 101, 102, 200, 201, 202, 300]
    assert len(calls) == 3


def test_an_ensemble_has_the_last_k_plans():
    plan, _ = counting(3)
    policy = chunking.ensembled_policy(plan, 3, 0.0)
    done = [policy(np.zeros((2, 4))) for _ in range(4)]
    assert [one.shape for one in done] == [(2, 2)] * 4
    wanted = [100, (101 + 200) / 2, (102 + 201 + 300) / 3, (202 + 301 + 400) / 3]
    assert_same([one[1, 1] for one in done], wanted, 1e-12)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: chunking.action_chunks([[1.0]], [0], 0), "K is 0"),
        (lambda: chunking.action_chunks([[1.0]], [0, 0], 1), "expected \\(n, m\\)"),
        (lambda: chunking.masked_l1([[[1.0]]], [[[0.0]]], [[0]]), "the mask is 0"),
        (lambda: chunking.masked_l1([[[1.0]]], [[[0.0]]], [0]), "mask has shape"),
        (
            lambda: chunking.encoder_gradient([[1]], [[1]], [[1]], [1], 1.0),
            "expected \\(n, z\\)",
        ),
        (
            lambda: chunking.backprop([[1]], [[1, 2]], *[np.eye(1), np.zeros(1)] * 3),
            "d has shape",
        ),
        (lambda: chunking.temporal_ensemble(np.ones((3, 2, 1)), 0.0), "3 plans of 2"),
        (lambda: chunking.started_share(-1, 2), "wait is -1"),
        (lambda: chunking.ensemble_noise(0, 0.0), "k is 0"),
        (lambda: chunking.attention([[1.0]], [[1.0, 2]], [[1.0]]), "k has shape"),
    ],
)
def test_what_cannot_be_computed_is_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call()


def test_the_dock_is_left_on_both_sides_and_after_the_wait():
    both = push.dock_demonstrations(40, 3)
    assert both.home().all()
    assert 10 < np.sum(push.on_the_left(both)) < 30
    left = push.dock_demonstrations(40, 3, coin=False, wait=4)
    assert push.on_the_left(left).all()
    assert left.action.shape == (40, push.STEPS + 4, 2)
    assert not left.action[:, :4].any()
    assert left.action[:, 4].any(axis=1).all()
    assert_same(left.observation[:, 4], both.observation[:, 0], 1e-12)

"""Behaviour cloning: gradients against the complex step, and the rest by hand."""

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial import cKDTree

from robo47 import cloning

SEEDS = st.integers(0, 2**32 - 1)


def some_net(rng, a=3, h=5, g=4, m=2):
    """Return the arrays of a net whose layers all differ in size."""
    sizes = ((a, h), (h,), (h, g), (g,), (g, m), (m,))
    return [0.7 * rng.normal(size=size) for size in sizes]


def test_the_contact_angle_solves_its_differential_equation():
    for phi, way in ((0.1, 0.065), (-0.4, 0.1), (2.5, 0.03), (0.3, -0.05)):
        way_of = (0.0, way)
        ode = solve_ivp(
            lambda s, y: np.sin(y) / 0.065, way_of, [phi], rtol=1e-12, atol=1e-13
        )
        assert_same(cloning.contact_angle(phi, way, 0.065), ode.y[0, -1], 1e-10)
    assert cloning.contact_angle(0.1, 0.065, 0.065) == pytest.approx(0.270395, abs=1e-6)
    assert_same(cloning.contact_angle([0.1, 0.0], 0.0, 1.0), [0.1, 0.0], 1e-16)


def test_whole_episodes_are_held_out():
    held = cloning.split_by_episode([4, 4, 0, 0, 2], [2, 4, 9])
    assert held.tolist() == [True, True, False, False, True]
    assert not cloning.split_by_episode([1, 2], []).any()


@given(SEEDS)
def test_normalised_columns_have_mean_0_and_std_1_and_come_back(seed):
    rng = np.random.default_rng(seed)
    x = rng.normal(3.0, 5.0, (7, 3))
    x[:, 1] = 0.1  # its std is 1.4e-17, not 0
    scaler = cloning.fit_scaler(x)
    z = cloning.normalise(x, scaler)
    assert scaler[1, 1] == 1
    assert_same(z.mean(axis=0), np.zeros(3), 1e-14)
    assert_same(z.std(axis=0), [1, 0, 1], 1e-14)
    assert_same(cloning.denormalise(z, scaler), x, 1e-13)


def test_the_worked_cases():
    scaler = cloning.fit_scaler([[1, 4], [3, 4]])
    assert_same(scaler, [[2, 4], [1, 1]], 0)
    assert_same(cloning.normalise([[5, 4]], scaler), [[3, 0]], 0)
    eye = np.eye(2)
    out = cloning.mlp([[1, 2]], eye, [0, 0], eye, [0, 0], np.ones((2, 1)), [0.5])
    assert_same(out, [[1.888083]], 1e-6)
    loss, slope = cloning.mse([[1, 2]], [[0, 0]])
    assert loss == 2.5
    assert_same(slope, [[1, 2]], 0)
    one = np.ones((1, 1)), np.zeros(1)
    grads = cloning.mlp_gradient([[1]], [[0]], *one, *one, *one)
    wanted = [0.316986, 0.316986, 0.574832, 0.754774, 0.824366, 1.284030]
    assert_same(cloning.flat(grads), wanted, 1e-6)
    step = cloning.adam_step(1.0, 3.0, 0.0, 0.0, 1, 0.01)
    assert_same(np.ravel(step), [0.99, 0.3, 0.009], 1e-9)
    loss = cloning.persistence_loss([[0], [1], [5], [5.5]], [0, 0, 1, 1])
    assert loss == 0.625
    assert_same(cloning.nearest_distance([[0, 0], [3, 4]], [[0, 1]]), [1], 0)


@given(SEEDS)
def test_the_gradient_is_that_of_the_complex_step(seed):
    rng = np.random.default_rng(seed)
    net = some_net(rng)
    x, target = rng.normal(size=(6, 3)), rng.normal(size=(6, 2))

    def loss(*arrays):
        return cloning.mse(cloning.mlp(x, *arrays), target)[0]

    wanted = cloning.complex_step(loss, net)
    for mine, theirs in zip(cloning.mlp_gradient(x, target, *net), wanted, strict=True):
        assert_same(mine, theirs, 1e-13)


@given(SEEDS)
def test_the_slope_of_the_loss_is_that_of_the_complex_step(seed):
    rng = np.random.default_rng(seed)
    pred, target = rng.normal(size=(2, 4, 3))
    wanted = cloning.complex_step(lambda p: cloning.mse(p, target)[0], [pred])[0]
    assert_same(cloning.mse(pred, target)[1], wanted, 1e-15)


def test_what_is_not_finite_stays_so():
    rng = np.random.default_rng(0)
    x = np.array([[1.0, np.nan, 2.0], [1, 2, 3]])
    out = cloning.mlp(x, *some_net(rng))
    assert np.isnan(out[0]).all()
    assert np.isfinite(out[1]).all()
    assert np.isnan(cloning.fit_scaler(x)[:, 1]).all()


@given(SEEDS)
def test_adam_is_the_sum_over_all_gradients(seed):
    rng = np.random.default_rng(seed)
    theta, grads = rng.normal(size=3), rng.normal(size=(5, 3))
    m = v = np.zeros(3)
    new = theta
    for k, grad in enumerate(grads, 1):
        new, m, v = cloning.adam_step(new, grad, m, v, k, 0.01)
        weights = [b ** np.arange(k - 1, -1, -1) for b in cloning.BETAS]
        first = weights[0] @ grads[:k] / weights[0].sum()  # weighted means
        second = weights[1] @ grads[:k] ** 2 / weights[1].sum()
        theta = theta - 0.01 * first / (np.sqrt(second) + 1e-8)
        assert_same(new, theta, 1e-14)


def test_the_first_step_of_adam_is_the_sign():
    grad = np.array([1e-3, -5.0, 1e4])
    new, _, _ = cloning.adam_step(np.zeros(3), grad, np.zeros(3), np.zeros(3), 1, 0.1)
    assert_same(new, -0.1 * np.sign(grad), 2e-6)


def test_a_number_that_comes_again_is_another_episode():
    action = np.array([[0.0], [1], [7], [7], [9], [10]])
    loss = cloning.persistence_loss(action, [0, 0, 1, 1, 0, 0])
    assert loss == pytest.approx((1 + 0 + 1) / 3)


@given(SEEDS)
def test_the_nearest_distance_is_a_trees(seed):
    rng = np.random.default_rng(seed)
    known, asked = rng.normal(size=(20, 3)), rng.normal(size=(7, 3))
    wanted = cKDTree(known).query(asked)[0]
    assert_same(cloning.nearest_distance(known, asked), wanted, 1e-15)


def test_a_flat_net_is_shaped_again_and_a_random_one_says_0():
    rng = np.random.default_rng(1)
    net = cloning.random_net(rng, 4, 6, 2)
    again = cloning.shaped(cloning.flat(net), net)
    for one, two in zip(net, again, strict=True):
        assert_same(one, two, 0)
    assert_same(cloning.mlp(rng.normal(size=(5, 4)), *net), np.zeros((5, 2)), 0)
    with pytest.raises(ValueError, match="theta has shape"):
        cloning.shaped(np.zeros(3), net)


def test_a_fit_finds_a_line():
    rng = np.random.default_rng(2)
    x = rng.normal(size=(300, 2))
    y = x @ [[1.0], [-2]] + 0.5

    def slope(rows, net):
        W, b = net
        error = 2 * (x[rows] @ W + b - y[rows]) / len(rows)
        return x[rows].T @ error, error.sum(axis=0)

    steps = cloning.batches(rng, len(x), 64, range(1, 501))
    W, b = cloning.fit(
        [np.zeros((2, 1)), np.zeros(1)],
        slope,
        steps,
        lambda k: cloning.cosine_rate(k, 500, 0.05),
    )
    assert_same(np.ravel([*W, b]), [1, -2, 0.5], 1e-3)
    assert cloning.cosine_rate(1, 500, 0.05) == 0.05


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: cloning.contact_angle(0.1, 0.1, 0.0), "R is 0; it must be above 0"),
        (lambda: cloning.split_by_episode([[1]], [1]), "episode has shape"),
        (lambda: cloning.fit_scaler(np.zeros((0, 2))), "no rows"),
        (lambda: cloning.normalise(np.zeros((2, 3)), np.zeros((2, 2))), "the scaler"),
        (lambda: cloning.mse(np.zeros((2, 1)), np.zeros((1, 2))), "the same"),
        (lambda: cloning.mlp([[1.0]], *[np.eye(2), np.zeros(2)] * 3), "W1 has shape"),
        (lambda: cloning.adam_step(0.0, 0.0, 0.0, 0.0, 0, 0.1), "k is 0"),
        (lambda: cloning.adam_step(0.0, [0.0], 0.0, 0.0, 1, 0.1), "have the shapes"),
        (lambda: cloning.persistence_loss([[1.0]], [0]), "no episode has two"),
        (lambda: cloning.persistence_loss([[1.0]], [0, 1]), "episode has 2 entries"),
        (lambda: cloning.nearest_distance(np.zeros((0, 2)), [[1.0, 2]]), "at least 1"),
    ],
)
def test_what_cannot_be_computed_is_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call()

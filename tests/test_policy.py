"""A policy's six numbers, its worth, its learning and its interval."""

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from robo47 import policy, se3

SEEDS = st.integers(0, 2**32 - 1)
ANGLES = st.floats(-20, 20)
THETA = np.array([0.01, 0, 0.1, 0.02, 0, 0.2])


def seen(yaw, x=0.4, y=0.1, noise=(0, 0, 0)):
    """Return what is observed of an upright cube."""
    return policy.observe(se3.make_T(se3.Rz(yaw), (x, y, 0.02)), noise)


def test_a_yaw_of_1_is_seen_as_a_cube_looks():
    assert_same(seen(1.0), [0.4, 0.1, 1.0 - np.pi / 2], 1e-15)


@given(ANGLES, st.integers(-4, 4), st.floats(-2, 2))
def test_a_cube_looks_the_same_four_times_a_turn_whatever_the_noise(yaw, k, noise):
    one = seen(yaw, noise=(0, 0, noise))[2]
    assert -np.pi / 4 <= one < np.pi / 4
    apart = one - seen(yaw + k * np.pi / 2, noise=(0, 0, noise))[2]
    assert abs((apart + 0.1) % (np.pi / 2) - 0.1) < 1e-12
    assert abs(np.sin(4 * (one - yaw - noise))) < 1e-12


def test_the_noise_comes_before_the_fold():
    over = seen(np.pi / 4 - 0.01, noise=(0.001, -0.002, 0.03))
    assert_same(over, [0.401, 0.098, 0.02 - np.pi / 4], 1e-15)


@given(SEEDS)
def test_the_hand_goes_beside_the_cube_in_the_cubes_axes(seed):
    draw = np.random.default_rng(seed)
    theta = draw.uniform(policy.LOW, policy.HIGH)
    x, y, yaw = draw.uniform(-0.7, 0.7, 3)
    out = policy.act(theta, [x, y, yaw])
    shift = Rotation.from_euler("z", yaw).apply([*theta[:2], 0.0])
    assert_same(out, [x + shift[0], y + shift[1], yaw + theta[2], *theta[3:]], 1e-15)


def test_the_worked_case_of_act_and_what_is_beyond_the_hand():
    out = policy.act(THETA, [0.4, 0.1, np.pi / 6])
    assert_same(out, [0.4086602540, 0.105, 0.6235987756, 0.02, 0, 0.2], 1e-9)
    assert_same(policy.act(np.full(6, 9.0), np.zeros(3)), policy.HIGH, 0)
    assert_same(policy.act(np.full(6, -9.0), np.zeros(3)), policy.LOW, 0)


def test_what_was_thrown_or_lost_is_worth_less_than_nothing():
    heights = [0.01, 0.05, 0.2, 0.9, np.nan, -0.01, np.inf, -np.inf, 0.3]
    worth = policy.reward(heights, 0.05, 0.3)
    assert_same(worth, [0.2, 1, 1, -1, -1, 0, -1, -1, 1], 1e-15)


def test_the_worked_case_of_a_step_and_where_a_nan_goes():
    noise = np.array([[0, 0], [1, 1], [-1, 2], [3, 3]])
    mean, std = policy.cem_step([1, 0], [2, 1], noise, [1, 5, 5, np.nan], 2)
    assert_same(mean, [1, 1.5], 1e-15)
    assert_same(std, [2, 0.5], 1e-15)


def test_of_equals_the_first_is_kept():
    noise = np.arange(6.0)[:, None]
    mean, std = policy.cem_step([0], [1], noise, [0, 1, 1, 1, 0, 1], 2)
    assert_same(mean, [1.5], 0)
    assert_same(std, [0.5], 0)


@given(SEEDS)
def test_learning_finds_the_middle_of_a_bowl(seed):
    draw = np.random.default_rng(seed)
    goal = draw.uniform(-1, 1, 3)
    mean, std = np.zeros(3), np.ones(3)
    for _ in range(30):
        noise = draw.normal(size=(60, 3))
        scores = -np.sum((mean + std * noise - goal) ** 2, axis=1)
        mean, std = policy.cem_step(mean, std, noise, scores, 15)
    assert np.abs(mean - goal).max() < 0.05
    assert std.max() < 0.1


@pytest.mark.parametrize(("k", "n"), [(8, 8), (97, 100), (0, 60), (1, 2), (18, 60)])
def test_the_interval_ends_at_the_roots_of_wilsons_quadratic(k, n):
    won = np.arange(n) < k
    rate, low, high = policy.success_rate(won)
    z2 = 1.96**2
    p = k / n  # (p - x)^2 = z^2 x (1 - x) / n
    roots = np.sort(np.roots([1 + z2 / n, -2 * p - z2 / n, p**2]).real)
    assert rate == p
    assert_same([low, high], roots, 1e-9 if k in (0, n) else 1e-14)
    assert low <= rate <= high


def test_the_worked_cases_of_a_rate():
    assert_same(policy.success_rate([True] * 8), [1, 0.6756, 1], 5e-5)
    assert_same(policy.success_rate([1] * 97 + [0] * 3), [0.97, 0.9155, 0.9897], 5e-5)


def test_a_difference_on_the_same_cubes_is_surer_than_two_rates():
    first, second = np.arange(100) < 80, np.arange(100) < 25
    both = policy.paired_difference(first, second)
    assert_same(both, [0.55, np.sqrt(0.55 * 0.45 / 100)], 1e-15)
    alone = np.sqrt((0.8 * 0.2 + 0.25 * 0.75) / 100)
    assert both[1] < alone
    assert_same(policy.paired_difference(second, first), [-0.55, both[1]], 1e-15)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: policy.observe(np.eye(4), [0, 0]), "noise has shape"),
        (lambda: policy.act(np.zeros(5), np.zeros(3)), "theta has shape"),
        (lambda: policy.reward(0.1, 0.05, 0.3), "heights has shape"),
        (lambda: policy.reward([0.1], 0.0, 0.3), "target is 0"),
        (lambda: policy.cem_step([0], [1], [[0]], [1], 2), "elite is 2"),
        (lambda: policy.cem_step([0], [1], [[0]], [1, 2], 1), "scores has shape"),
        (lambda: policy.success_rate([0.5]), "True and False"),
        (lambda: policy.paired_difference([1], [1, 0]), "shape"),
    ],
)
def test_what_is_no_policy_is_refused_by_name(call, says):
    with pytest.raises(ValueError, match=says):
        call()

"""The sensitivity of Day 20's numbers: each constant doubled, measured, explained."""

from unittest.mock import patch

import numpy as np

from labkit.lesson.constants import Numbers, between
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(20))

numbers = Numbers(
    off="distance of the mean action from the best: {}",
    noise="std of the action: {}",
    baseline="baseline: {}",
    episodes="episodes of an estimate: {}",
    horizon="steps of an episode: {}",
    std="std of the force: {}",
    effort="cost of the force: {}",
    seed="seed: {}",
)


def cart(name, episodes, std, horizon, seed):
    """Return the mean and the std of the estimates by an estimator's name."""
    with patch.multiple(LAB, STD=std, HORIZON=round(horizon)):
        some = LAB.Cart(np.random.default_rng(seed), LAB.BATCHES * round(episodes))
        found = some.estimates(LAB.weights_of(some)[name])
    return found.mean(axis=0), np.linalg.norm(found.std(axis=0, ddof=1))


@numbers.add(
    "variance of a one-step estimate, with the mean reward", "{:.2f}",
    off=between(2.5, 4.0, "8 d² + 10 std²"),
    noise=between(1.0, 2.0, "8 d² + 10 std²"),
)  # fmt: skip
def one_step(off=0.7, noise=0.4):
    """Return the variance with the mean reward as a baseline."""
    with patch.object(LAB, "NOISE", noise):
        return LAB.one_step_variance(off, -(off**2) - noise**2)


@numbers.add(
    "std of an estimate, return to go", "{:.1f}",
    episodes=between(0.65, 0.77, "1 / sqrt(2)"),
    horizon=between(0.95, 1.2, "after 30 steps the cart is near its goal"),
    std=between(0.45, 0.65, "scores shrink; returns depend on the start"),
    seed=between(0.8, 1.25, "other episodes"),
)  # fmt: skip
def to_go(episodes=LAB.EACH, horizon=LAB.HORIZON, std=LAB.STD, seed=LAB.SEED):
    """Return the standard deviation."""
    return cart("return to go", episodes, std, horizon, seed)[1]


@numbers.add(
    "std of an estimate, exact value", "{:.2f}",
    episodes=between(0.65, 0.77, "1 / sqrt(2)"),
    horizon=between(0.95, 1.2, "after 30 steps the cart is near its goal"),
    std=between(0.9, 1.3, "advantages grow with std, scores shrink"),
    seed=between(0.8, 1.25, "other episodes"),
)  # fmt: skip
def exact_value(episodes=LAB.EACH, horizon=LAB.HORIZON, std=LAB.STD, seed=LAB.SEED):
    """Return the standard deviation."""
    return cart("exact value, lambda 1", episodes, std, horizon, seed)[1]


@numbers.add(
    "mean estimate with half the value, lambda 0.5, first entry", "{:.2f}",
    episodes=between(0.9, 1.1, "more data do not reduce the bias"),
    seed=between(0.9, 1.1, "the bias is not due to chance"),
)  # fmt: skip
def biased(episodes=LAB.EACH, seed=LAB.SEED):
    """Return the first entry of the mean estimate."""
    return cart("half the value, lambda 0.5", episodes, LAB.STD, LAB.HORIZON, seed)[0][0]


@numbers.add(
    "first entry of the exact gradient", "{:.3f}",
    std=between(1.0, 1.3, "the noise adds to E[x x^T]"),
    horizon=between(1.0, 1.3, "the cart is near its goal after 30 steps"),
    effort=between(0.5, 1.0, "a larger gain costs more"),
)  # fmt: skip
def slope(std=LAB.STD, horizon=LAB.HORIZON, effort=0.1):
    """Return the first entry of the gradient of the return."""
    rest = std, LAB.A, LAB.B, LAB.Q, np.array([[effort]]), LAB.START, round(horizon)
    return -LAB.policy_cost_gradient(LAB.GAIN, *rest)[0, 0]

"""Mixtures of Gaussians as questions, and the parts of their exact predictions."""

import numpy as np


def mixtures(rng):
    """Yield rows of x with means, sigma and weights of a mixture: small, all sizes."""
    for n, k, d in ((3, 2, 1), (2, 3, 2), (4, 1, 2), (1, 2, 3), (3, 4, 1)):
        weights = rng.numbers(0.2, 1, k)
        sigma = float(rng.numbers(0.05, 0.6))
        yield rng.numbers(-1.5, 1.5, n, d), rng.numbers(-1, 1, k, d), sigma, weights


def posterior(x, keep, lose, means, sigma, weights, wide=True):
    """Return the probability of each mode, the distance from it, and its variance.

    Args:
        x: keep data + lose noise, (n, d).
        keep, lose: factors of data and noise.
        means, sigma, weights: the mixture.
        wide: the variance contains the width of the data.
    """
    variance = wide * (keep * sigma) ** 2 + lose**2
    off = x[:, None] - keep * means
    power = -0.5 * np.sum(off**2, axis=2) / variance
    prob = weights * np.exp(power - power.max(axis=1, keepdims=True))
    return (prob / prob.sum(axis=1, keepdims=True))[..., None], off, variance

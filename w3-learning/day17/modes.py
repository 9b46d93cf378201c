"""Mixtures of Gaussians as questions, and the parts of their exact predictions."""

import numpy as np

TWO = np.array([[-1.0], [1]])  # the means of a mixture of two modes


def asked(rng, known, far):
    """Yield questions (x, amount of noise, means, sigma, weights).

    Args:
        rng: draws the mixtures.
        known: amount of noise of the call that is checked by hand.
        far: amount of noise of rows of x far from all modes.
    """
    yield np.array([[0.5]]), known, TWO, 0.1, np.array([0.5, 0.5])
    for x, *mixture in mixtures(rng):
        yield x, float(rng.numbers(0.1, 0.9)), *mixture
    x, means, sigma, weights = next(mixtures(rng))
    yield x, 0.0, means, sigma, weights
    yield x, 1.0, means, sigma, weights
    yield x, 0.5, means, 0.0, weights
    yield 40 * x, far, means, sigma, weights


def cases(row):
    """Name the cases of a row whose calls end with means, sigma, weights."""
    row.cases(
        one_mode=lambda *given: len(given[-3]) == 1,
        several_modes=lambda *given: len(given[-3]) > 1,
    )
    row.cases(
        equal_weights=lambda *given: bool(np.ptp(given[-1]) == 0),
        different_weights=lambda *given: bool(np.ptp(given[-1]) > 0),
    )


def mixtures(rng):
    """Yield rows of x with means, sigma and weights of a mixture: small, all sizes."""
    for n, k, d in ((3, 2, 1), (2, 3, 2), (4, 1, 2), (1, 2, 3), (3, 4, 1)):
        weights = rng.numbers(0.2, 1, k)
        weights = np.round(weights / weights.sum(), 3)
        weights[-1] = np.round(1 - weights[:-1].sum(), 3)  # their sum is 1
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
    return posterior_of(off, variance, weights), off, variance


def posterior_of(off, variance, weights):
    """Return the probability of each mode, (n, k, 1), from the distances, (n, k, d)."""
    power = -0.5 * np.sum(off**2, axis=2) / variance
    prob = weights * np.exp(power - power.max(axis=1, keepdims=True))
    return (prob / prob.sum(axis=1, keepdims=True))[..., None]


def wrong_probabilities(off, variance, weights):
    """Return wrong probabilities of the modes, (n, k, 1) or (n, k, d), by mistake."""
    n, k, _ = off.shape
    squares = np.sum(off**2, axis=2)
    power = -squares / (2 * variance)
    likely = np.log(weights) + power
    plain = weights * np.exp(power)
    single = -(off**2) / (2 * variance)
    single = np.exp(single - single.max(axis=1, keepdims=True))

    def normalised(prob):
        return prob / prob.sum(axis=1, keepdims=True)

    def by(most):
        return normalised(weights * np.exp(power - most))[..., None]

    of_most = weights * np.exp(power - power.max(axis=1, keepdims=True))
    of_likely = np.exp(likely - likely.max(axis=1, keepdims=True))
    return {
        "nearest-mode": np.eye(k)[np.argmin(squares, axis=1)][..., None],
        "nearest-mode 2": np.eye(k)[np.argmax(likely, axis=1)][..., None],
        "weights-only": np.tile(weights / weights.sum(), (n, 1))[..., None],
        "per-coordinate": normalised(weights[:, None] * single),
        "over-all-rows": (of_most / of_most.sum())[..., None],
        "over-all-rows 2": (of_likely / of_likely.sum())[..., None],
        "overflow": by(0),
        "overflow 2": by(power.max()),
        "overflow 3": by(power.max(axis=0)),
        "overflow 4": np.nan_to_num(by(0)),
        "overflow 5": (plain / (plain.sum(axis=1, keepdims=True) + 1e-12))[..., None],
    }

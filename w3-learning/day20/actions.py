"""Actions of a Gaussian policy, and logarithms of probabilities, as questions."""

import numpy as np


def gaussians(rng):
    """Yield actions, means and log_std; the docstring's case comes first."""
    yield np.ones((1, 1)), np.zeros((1, 1)), np.array([0.693147])
    for n, m in ((1, 2), (3, 1), (4, 2), (2, 3)):
        yield rng.numbers(-1, 1, n, m), rng.numbers(-1, 1, n, m), rng.numbers(-1, 1, m)
    yield rng.numbers(-1, 1, 3, 2), rng.numbers(-1, 1, 3, 2), np.zeros(2)  # std 1


def logps(rng, n):
    """Return two logarithms of probabilities, (n,) each, with ratios near 1 and far."""
    old = rng.numbers(-3, 0, n)
    return old + rng.numbers(-0.9, 0.9, n), old

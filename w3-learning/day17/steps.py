"""Steps of a sampler as questions: samples, their noise, and two levels."""

import numpy as np


def steps(rng):
    """Yield x, eps, abar and prev, from large steps to the last one."""
    for n, d in ((3, 2), (1, 3), (4, 1), (2, 2)):
        abar, prev = np.sort(rng.numbers(0.05, 0.95, 2))
        yield (*rng.numbers(-2, 2, 2, n, d), float(abar), float(prev) + 0.002)
    yield (*rng.numbers(-2, 2, 2, 2, 2), 0.6, 1.0)  # the last step
    yield (*rng.numbers(-2, 2, 2, 3, 1), 0.001, 0.02)  # much noise

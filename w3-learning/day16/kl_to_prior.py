"""16.6 `kl_to_prior(mu, logvar)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None), unit="nats"))


@row.inputs
def _(rng):
    yield np.array([[1.0, 0]]), np.array([[0, np.log(4)]])
    yield np.zeros((1, 1)), np.zeros((1, 1))  # the prior itself
    for n, z in ((1, 1), (3, 1), (2, 2), (4, 3)):
        yield rng.numbers(-2, 2, n, z), rng.numbers(-2, 2, n, z)
    yield rng.numbers(-2, 2, 3, 2), np.zeros((3, 2))
    yield np.zeros((3, 2)), rng.numbers(-2, 2, 3, 2)


row.cases(
    means_of_0=lambda mu, logvar: not mu.any(),
    other_means=lambda mu, logvar: bool(mu.all()),
)
row.cases(
    variances_of_1=lambda mu, logvar: not logvar.any(),
    other_variances=lambda mu, logvar: bool(logvar.all()),
)


@row.wrongs
def _(mu, logvar):
    """bits: your function returns the divergence in bits. Use the natural logarithm
      instead of the logarithm to the base 2, so that the unit is nats
    swapped: your function returns the divergence of the prior p from the Gaussian q.
      Return the mean of `ln q - ln p` under q instead
    log-of-std: your code uses logvar as the logarithm of the standard deviation. The
      variance is exp(logvar), so the standard deviation is exp(logvar / 2)
    entropy: your function returns the entropy of the Gaussian q. Return the mean of `ln
      q - ln p` under q instead, where p is the prior
    """
    var = np.exp(logvar)
    right = (var + mu**2 - 1 - logvar) / 2
    return {
        "bits": right / np.log(2),
        "swapped": ((1 + mu**2) / var - 1 + logvar) / 2,
        "log-of-std": (var**2 + mu**2 - 1) / 2 - logvar,
        "entropy": (np.log(2 * np.pi) + 1 + logvar) / 2 + 0 * mu,
    }


@row.right  # From the standard deviation.
def _(mu, logvar):
    std = np.exp(0.5 * logvar)
    return -np.log(std) + (std * std + mu * mu) / 2 - 0.5


@row.right  # The mean of ln q - ln p.
def _(mu, logvar):
    log_q = -0.5 * (1 + logvar)
    log_p = -0.5 * (np.exp(logvar) + mu**2)
    return log_q - log_p


@row.spans
def _(rng):
    for logvar in (-12.0, 4.0):
        yield 5 * rng.numbers(-1, 1, 3, 1), np.full((3, 1), logvar)

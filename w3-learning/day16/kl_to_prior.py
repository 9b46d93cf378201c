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
    """bits: your divergence is in bits. Use the natural logarithm, which gives nats
    half-forgotten: your divergence lacks the factor 1/2
    swapped: your divergence is the one of the prior from the Gaussian, with both
      distributions swapped. Take the mean under the Gaussian with mu and logvar
    std-for-variance: in your code, exp(logvar / 2) is used, the standard deviation.
      The divergence contains the variance
    entropy-only: your divergence lacks mu^2. A mean that differs from 0 costs as well
    one-forgotten: your divergence is too large by 1/2, because the -1 is missing. A
      standard normal distribution has the divergence 0
    sign-of-logvar: in your code, logvar is added. The divergence is 0 and minimal at
      logvar = 0, so its derivative there is 0
    """
    var = np.exp(logvar)
    right = (var + mu**2 - 1 - logvar) / 2
    return {
        "bits": right / np.log(2),
        "half-forgotten": 2 * right,
        "swapped": ((1 + mu**2) / var - 1 + logvar) / 2,
        "std-for-variance": (np.exp(logvar / 2) + mu**2 - 1 - logvar) / 2,
        "entropy-only": (var - 1 - logvar) / 2,
        "one-forgotten": (var + mu**2 - logvar) / 2,
        "sign-of-logvar": (var + mu**2 - 1 + logvar) / 2,
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

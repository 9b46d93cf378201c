"""16.5 `reparameterise(mu, logvar, noise)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    yield np.array([[1.0]]), np.array([[np.log(4)]]), np.array([[0.5]])
    for n, z in ((1, 1), (3, 1), (2, 2), (4, 3), (1, 2)):
        mu, logvar, noise = (rng.numbers(-2, 2, n, z) for _ in range(3))
        yield mu, logvar, noise
    yield rng.numbers(-1, 1, 2, 2), np.zeros((2, 2)), rng.numbers(-1, 1, 2, 2)


row.cases(
    variances_of_1=lambda mu, logvar, noise: not logvar.any(),
    other_variances=lambda mu, logvar, noise: bool(logvar.all()),
)


@row.wrongs
def _(mu, logvar, noise):
    """exp-of-logvar: your code multiplies the noise by the variance. Multiply the noise
      by the standard deviation instead, which is the square root of the variance
    base-2: your code treats logvar as a base-2 logarithm. Use exp instead of powers of
      2, because logvar is the natural logarithm of the variance
    logvar-as-std: your code multiplies the noise by logvar, which is the logarithm of
      the variance. Multiply the noise by the standard deviation instead
    half-variance: your code multiplies the noise by half of the variance. Halve logvar
      before you apply exp instead, because the standard deviation is the square root of
      exp(logvar)
    root-of-the-log: your code multiplies the noise by the square root of the absolute
      value of logvar. Compute the variance exp(logvar) first, and then take its square
      root
    softplus: your code uses ln(1 + exp(logvar)) as the variance. Use exp(logvar)
      instead, because logvar is the logarithm of the variance
    standardised: your code subtracts the mean from the noise and divides by the
      standard deviation. This computation converts a sample to noise. Use its inverse
      instead, which converts the noise to a sample
    """
    std = np.exp(logvar / 2)
    return {
        "exp-of-logvar": mu + std**2 * noise,
        "base-2": mu + 2 ** (logvar / 2) * noise,
        "logvar-as-std": mu + logvar * noise,
        "half-variance": mu + std**2 / 2 * noise,
        "root-of-the-log": mu + np.sqrt(np.abs(logvar)) * noise,
        "softplus": mu + np.sqrt(np.log1p(std**2)) * noise,
        "standardised": (noise - mu) / std,
    }


@row.right  # The root of the variance.
def _(mu, logvar, noise):
    return np.sqrt(np.exp(logvar)) * noise + mu


@row.right  # Row by row.
def _(mu, logvar, noise):
    rows = []
    for a, b, c in zip(mu, logvar, noise):
        rows.append([m + np.e ** (0.5 * s) * e for m, s, e in zip(a, b, c)])
    return np.array(rows)


@row.spans
def _(rng):
    mu, noise = rng.numbers(-1, 1, 2, 3, 1)
    for logvar in (-12.0, 4.0):
        yield 5 * mu, np.full((3, 1), logvar), 4 * noise
    yield 1e-3 * mu, 1e-3 * noise, 1e-3 * mu

"""16.7 `encoder_gradient(dz, mu, logvar, noise, beta)`: questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row((
    Matrix((None, None), called="the gradient of mu"),
    Matrix((None, None), called="the gradient of logvar"),
))  # fmt: skip


def state(rng, n, z):
    """Return dz, mu, logvar and noise, (n, z) each."""
    return tuple(rng.numbers(-2, 2, n, z) for _ in range(4))


@row.inputs
def _(rng):
    yield *(np.array([[a]]) for a in (2.0, 1.0, 0.0, 0.5)), 0.1
    for n, z, beta in ((1, 1, 0.5), (3, 1, 0.1), (2, 2, 1.0), (4, 3, 0.3)):
        yield *state(rng, n, z), beta
    dz, mu, logvar, noise = state(rng, 3, 2)
    yield dz, mu, logvar, noise, 0.0
    yield 0 * dz, mu, logvar, noise, 0.5
    yield dz, 0 * mu, 0 * logvar, noise, 0.5  # the prior itself
    yield *state(rng, int(rng.integers(2, 5)), 1), float(rng.numbers(0.05, 1))


row.cases(
    one_row=lambda dz, *_: len(dz) == 1,
    several_rows=lambda dz, *_: len(dz) > 1,
)
row.cases(
    without_the_divergence=lambda dz, mu, logvar, noise, beta: beta == 0,
    with_the_divergence=lambda dz, mu, logvar, noise, beta: beta != 0,
)


@row.wrongs
def _(dz, mu, logvar, noise, beta):
    """noise-forgotten: your gradient of logvar does not contain the noise. The
      derivative of the sample with respect to logvar is noise exp(logvar / 2) / 2
    kl-not-divided: in your code, the divergence is summed over the rows. The loss
      contains its mean: divide by n
    kl-not-divided 2: your function divides the divergence by all n z entries. The loss
      sums over the columns and averages over the rows: divide by n
    dz-divided: in your code, dz is divided by n as well. It is a gradient of a mean
      already
    dz-not-passed-on: your gradient of logvar contains the divergence only. The sample
      depends on logvar as well
    """
    n = len(dz)
    each = beta / n
    std = np.exp(logvar / 2)
    first, var = dz * noise * std / 2, each * (std**2 - 1) / 2
    dmu = dz + each * mu
    z = dz.shape[1]
    return {
        "noise-forgotten": (dmu, dz * std / 2 + var),
        "kl-not-divided": (dz + beta * mu, first + n * var),
        "kl-not-divided 2": (dz + each * mu / z, first + var / z),
        "dz-divided": (dz / n + each * mu, first / n + var),
        "dz-not-passed-on": (dmu, var),
    }


@row.right  # From the sample and the divergence, each with the chain rule.
def _(dz, mu, logvar, noise, beta):
    std = np.sqrt(np.exp(logvar))
    dstd = dz * noise + beta / len(dz) * (std - 1 / std)
    return dz + beta * mu / len(dz), dstd * std / 2


@row.right  # By the complex step.
def _(dz, mu, logvar, noise, beta):
    def loss(m, s):
        kl = (np.exp(s) + m * m - 1 - s) / 2
        return dz * (m + np.exp(s / 2) * noise) + beta * kl / len(dz)

    h = 1e-30
    return loss(mu + 1j * h, logvar).imag / h, loss(mu, logvar + 1j * h).imag / h


@row.spans
def _(rng):
    dz, mu, logvar, noise = state(rng, 40, 1)
    yield dz, 3 * mu, 3 * logvar, 2 * noise, 1.0
    yield 1e-6 * dz, 1e-3 * mu, 1e-3 * logvar, 1e-3 * noise, 0.01

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
    calls_with_beta_0=lambda dz, mu, logvar, noise, beta: beta == 0,
    calls_with_another_beta=lambda dz, mu, logvar, noise, beta: beta != 0,
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
    by-the-std: your last result is the gradient with respect to the standard deviation.
      Multiply it by the derivative exp(logvar / 2) / 2 of the standard deviation
    by-the-std 2: in your code, dz is multiplied by the derivative of the sample with
      respect to the standard deviation. Multiply by exp(logvar / 2) / 2 as well
    sample-for-noise: in your gradient of logvar, dz is multiplied by the sample. mu
      does not depend on logvar, so only the noise belongs there
    sample-for-noise 2: in your gradient of logvar, dz is multiplied by the sample. mu
      does not depend on logvar, so only the noise belongs there
    beta-forgotten: in your gradient of logvar, the divergence is not multiplied by
      beta. The loss contains beta times the divergence
    beta-forgotten 2: in your code, the divergence is not multiplied by beta. The loss
      contains beta times the divergence
    not-differentiated: your gradient contains the divergence itself. It should
      contain its derivative
    not-differentiated 2: your gradient of mu contains mu^2 / 2, a term of the
      divergence itself. It should contain the derivative of this term
    """
    n = len(dz)
    each = beta / n
    std = np.exp(logvar / 2)
    first, var = dz * noise * std / 2, each * (std**2 - 1) / 2
    dmu = dz + each * mu
    columns = dz.shape[1]
    z = mu + std * noise
    kl = (std**2 + mu**2 - 1 - logvar) / 2
    return {
        "noise-forgotten": (dmu, dz * std / 2 + var),
        "kl-not-divided": (dz + beta * mu, first + n * var),
        "kl-not-divided 2": (dz + each * mu / columns, first + var / columns),
        "dz-divided": (dz / n + each * mu, first / n + var),
        "dz-not-passed-on": (dmu, var),
        "by-the-std": (dmu, dz * noise + each * (std - 1 / std)),
        "by-the-std 2": (dmu, dz * noise + var),
        "sample-for-noise": (dmu, dz * z / 2 + var),
        "sample-for-noise 2": (dmu, dz * z * std / 2 + var),
        "beta-forgotten": (dmu, first + (std**2 - 1) / (2 * n)),
        "beta-forgotten 2": (dz + mu / n, first + (std**2 - 1) / (2 * n)),
        "not-differentiated": (dz + each * kl, first + each * kl),
        "not-differentiated 2": (dz + each * mu**2 / 2, first + var),
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

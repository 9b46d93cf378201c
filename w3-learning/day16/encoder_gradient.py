"""16.7 `encoder_gradient(dz, mu, logvar, noise, beta)`: questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row((
    Matrix((None, None), called="the gradient with respect to mu"),
    Matrix((None, None), called="the gradient with respect to logvar"),
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
    """noise-forgotten: your code omits the noise from the gradient with respect to
      logvar. Multiply dz by noise * exp(logvar / 2) / 2, which is the derivative of the
      sample with respect to logvar
    kl-not-divided: your code uses the sum of the divergences over the rows. Divide the
      derivatives of this sum by n, because the loss contains the mean over the rows
    kl-not-divided 2: your code divides the derivatives of the divergence by the total
      number of entries, n * z. Divide them by n only, because the loss sums the
      divergence over the z columns
    dz-divided: your code divides dz by n. Omit this division, because dz is already the
      gradient of the decoder's loss
    dz-not-passed-on: your gradient with respect to logvar contains only the derivative
      of the divergence. Add dz times the derivative of the sample with respect to
      logvar, because the sample also depends on logvar
    by-the-std: your second result is the gradient with respect to the standard
      deviation. Multiply this gradient by exp(logvar / 2) / 2, which is the derivative
      of the standard deviation with respect to logvar
    by-the-std 2: your code multiplies dz by the derivative of the sample with respect
      to the standard deviation. Multiply this product by exp(logvar / 2) / 2, which is
      the derivative of the standard deviation with respect to logvar
    sample-for-noise: your code multiplies dz by half of the sample. Multiply dz by
      noise * exp(logvar / 2) / 2 instead, which is the derivative of the sample with
      respect to logvar
    sample-for-noise 2: your gradient with respect to logvar contains dz times the
      sample. Use the noise instead of the sample, because the derivative of the sample
      with respect to logvar does not contain mu
    beta-forgotten: your code omits the factor beta from the gradient with respect to
      logvar. Multiply the derivative of the divergence by beta, because the loss
      contains beta times the divergence
    beta-forgotten 2: your code omits the factor beta from both gradients. Multiply the
      derivatives of the divergence by beta, because the loss contains beta times the
      divergence
    not-differentiated: your gradients contain the divergence itself. Use the
      derivatives of the divergence with respect to mu and logvar instead
    not-differentiated 2: your gradient with respect to mu contains mu^2 / 2, which is a
      term of the divergence itself. Use the derivative of this term instead
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

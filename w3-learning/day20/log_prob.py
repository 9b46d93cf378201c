"""20.1 `log_prob(action, mean, log_std)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Vector

from .actions import gaussians


def far(rng):
    """Yield actions so far from the mean that exp gives 0 for their density."""
    for n, m in ((2, 1), (3, 2)):
        action, mean = rng.numbers(-1, 1, 2, n, m)
        action[0] += 120.0
        yield action, mean, rng.numbers(-1, 0.5, m)


row = Row(
    Vector((None,)),
    held_out=[
        HeldOut(
            "underflow",
            "Your function is correct for an action near its mean, but not for an "
            "action far from the mean. The density of such an action is so small that "
            "exp returns 0, whose logarithm is minus infinity. Take the logarithm of "
            "the formula on paper first, so that your code does not need this exp.",
            far,
        ),
    ],
)


@row.inputs
def _(rng):
    yield from gaussians(rng)


row.cases(
    a_std_of_1=lambda action, mean, log_std: not log_std.any(),
    another_std=lambda action, mean, log_std: bool(log_std.any()),
)
row.cases(
    one_entry=lambda action, mean, log_std: len(log_std) == 1,
    several_entries=lambda action, mean, log_std: len(log_std) > 1,
)


@row.wrongs
def _(action, mean, log_std):
    """determinant-forgotten: your code omits the term `-log_std` for each entry.
      Include this term, because the density of a Gaussian contains the factor 1 / std
    log-std-as-std: your code uses `log_std` as the standard deviation. Use exp(log_std)
      instead
    half-forgotten: your code omits the factor 1/2 in the exponent. The exponent of a
      Gaussian is -z^2 / 2, where z = (action - mean) / std
    averaged: your code takes the mean over the entries of each action. The entries are
      independent, so sum the log-probabilities of the entries instead
    not-squared: your code uses |z| instead of z^2, where z = (action - mean) / std. The
      exponent of a Gaussian is -z^2 / 2
    prob: your function returns the density. Return the logarithm of the density instead
    constant-once: your code includes the term -ln(2 * pi) / 2 only once. Add this term
      for each of the m entries of an action
    densities-summed: your code sums the densities of the entries before it takes the
      logarithm. Multiply these densities instead, because the entries are independent
    variance: your code divides `action - mean` by the variance before squaring. Divide
      this difference by the standard deviation instead, and then square
    """
    std = np.exp(log_std)
    z = (action - mean) / std
    const = 0.5 * np.log(2 * np.pi)

    def by(square, width=log_std):
        return (-square / 2 - width - const).sum(axis=1)

    right = by(z**2)
    some = np.where(log_std == 0, 1e-9, log_std)
    return {
        "determinant-forgotten": by(z**2, 0),
        "log-std-as-std": by(((action - mean) / some) ** 2, np.log(np.abs(some))),
        "half-forgotten": by(2 * z**2),
        "averaged": right / len(log_std),
        "not-squared": by(np.abs(z)),
        "prob": np.exp(right),
        "constant-once": right + (len(log_std) - 1) * const,
        "densities-summed": np.log(np.exp(-(z**2) / 2 - log_std - const).sum(axis=1)),
        "variance": by((z / std) ** 2),
    }


@row.right  # With the variance of each entry.
def _(action, mean, log_std):
    var = np.exp(log_std) ** 2
    return -((action - mean) ** 2 / var + np.log(2 * np.pi * var)).sum(axis=1) / 2


@row.right  # With a covariance matrix, row by row.
def _(action, mean, log_std):
    C = np.diag(np.exp(2 * log_std))
    _, log_det = np.linalg.slogdet(2 * np.pi * C)
    e = action - mean
    return np.array([-0.5 * (a @ np.linalg.solve(C, a) + log_det) for a in e])


@row.spans
def _(rng):
    wide = np.array([-0.9, 2.0])
    for size in (1e-3, 3.0):
        yield size * rng.numbers(-1, 1, 3, 2), size * rng.numbers(-1, 1, 3, 2), wide

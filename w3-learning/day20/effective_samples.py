"""20.8 `effective_samples(logp, old_logp)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Scalar

from .actions import logps


def far(rng):
    """Yield weights that exp cannot represent, large and small, and both at once.

    In the last calls the weights are moderate, and the probabilities are not.
    """
    for n in (3, 5):
        logp, old = logps(rng, n)
        yield np.append(logp + 900.0, logp[:2] - 900.0), np.append(old, old[:2])
    for n in (2, 4):
        logp, old = logps(rng, n)
        shift = -900.0 * (np.arange(n) % 2)
        yield logp + shift, old + shift
    for shift in (900.0, -900.0):
        for n in (2, 4):
            logp, old = logps(rng, n)
            yield logp + shift, old


row = Row(
    Scalar(),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is correct for moderate weights and probabilities. If exp "
            "overflows, becomes 0 or is limited, the result is NaN or wrong. Subtract "
            "the largest logp - old_logp before you call exp. This subtraction does "
            "not change the result.",
            far,
        ),
    ],
)


@row.inputs
def _(rng):
    yield np.log([3.0, 1.0]).round(6), np.zeros(2)
    for n in (1, 2, 3, 5):
        yield logps(rng, n)
    old = rng.numbers(-2, 0, 3)
    yield old.copy(), old  # equal weights
    yield old + 0.7, old


row.cases(
    equal_weights=lambda logp, old_logp: bool(np.ptp(logp - old_logp) < 1e-12),
    different_weights=lambda logp, old_logp: bool(np.ptp(logp - old_logp) >= 1e-12),
)


@row.rare
def _(rng):
    old = rng.numbers(-2, 0, 3)
    yield old + float(rng.numbers(-1, 1)), old


@row.wrongs
def _(logp, old_logp):
    """not-squared: your numerator is the sum of the weights. Square this sum, so that a
      common factor of all weights does not change the result
    log-weights: your code uses the logarithms of the weights as weights. Use exp(logp -
      old_logp) instead
    inverted: your function returns sum w^2 / (sum w)^2. The effective number of samples
      is the reciprocal, (sum w)^2 / sum w^2
    sum-over-largest: your code divides the sum of the weights by the largest weight.
      Divide the square of this sum by the sum of the squares instead
    squares-over-sum: your code divides the sum of the squares by the sum of the
      weights. Divide the square of the sum by the sum of the squares instead
    squares-over-sum 2: your code divides the sum of the squares by the sum of the
      weights. Divide the square of the sum by the sum of the squares instead
    by-the-entropy: your function returns exp of the entropy of the weights. Return (sum
      w)^2 / sum w^2 instead
    share: your code divides the effective number of samples by the number of samples.
      Return the effective number itself instead of a fraction
    new-only: your weights are exp(logp). The samples were drawn by the old policy, so
      use exp(logp - old_logp) instead
    """
    x = logp - old_logp
    w = np.exp(x)
    right = w.sum() ** 2 / np.sum(w**2)
    new = np.exp(logp)
    p, unit = w / w.sum(), w / w.max()
    return {
        "not-squared": w.sum() / np.sum(w**2),
        "log-weights": x.sum() ** 2 / np.sum(x**2),
        "sum-over-largest": w.sum() / w.max(),
        "squares-over-sum": np.sum(w**2) / w.sum(),
        "squares-over-sum 2": np.sum(unit**2) / unit.sum(),
        "by-the-entropy": np.exp(-np.sum(p * np.log(p))),
        "inverted": 1 / right,
        "share": right / len(w),
        "new-only": new.sum() ** 2 / np.sum(new**2),
    }


@row.right  # With normalised weights.
def _(logp, old_logp):
    x = logp - old_logp
    w = np.exp(x - np.max(x))
    w = w / w.sum()
    return 1 / (w @ w)


@row.right  # By the variance of the weights.
def _(logp, old_logp):
    x = logp - old_logp
    w = np.exp(x - np.max(x))
    return len(w) / (1 + np.var(w) / np.mean(w) ** 2)


@row.spans
def _(rng):
    logp, old = logps(rng, 30)
    yield logp, old
    yield 9 * logp, 9 * old


row.at_least_0(answer="a number")

"""20.8 `effective_samples(logp, old_logp)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Scalar

from .actions import logps


def far(rng):
    """Yield weights that exp cannot represent, large and small."""
    for shift in (900.0, -900.0):
        for n in (2, 4):
            logp, old = logps(rng, n)
            yield logp + shift, old


row = Row(
    Scalar(),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is right for moderate weights. If exp overflows, or if all "
            "weights are 0, it returns NaN. Subtract the largest logp - old_logp "
            "before exp: the result does not change.",
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


@row.wrongs
def _(logp, old_logp):
    """not-squared: your numerator is the sum of the weights. Square this sum, so that a
      common factor of all weights does not change the result
    log-weights: your code uses the logarithms of the weights as weights. Use exp(logp -
      old_logp) instead
    inverted: your function returns sum w^2 / (sum w)^2. The effective number of samples
      is the reciprocal, (sum w)^2 / sum w^2
    share: your code divides the effective number of samples by the number of samples.
      Return the effective number itself instead of a fraction
    new-only: your weights are exp(logp). The samples were drawn by the old policy, so
      use exp(logp - old_logp) instead
    """
    x = logp - old_logp
    w = np.exp(x)
    right = w.sum() ** 2 / np.sum(w**2)
    new = np.exp(logp)
    return {
        "not-squared": w.sum() / np.sum(w**2),
        "log-weights": x.sum() ** 2 / max(np.sum(x**2), 1e-300),
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
    w = np.exp(x - np.mean(x))
    return len(w) / (1 + np.var(w) / np.mean(w) ** 2)


@row.spans
def _(rng):
    logp, old = logps(rng, 30)
    yield logp, old
    yield 9 * logp, 9 * old


row.at_least_0(answer="a number")

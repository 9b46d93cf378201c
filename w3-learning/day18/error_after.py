"""18.1 `error_after(a, step, T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    yield 1.1, 0.1, 10
    yield 1.0, 0.1, 10
    yield 1.0, -0.5, 4
    yield 0.8, -0.5, 3
    yield 0.5, 2.0, 1
    yield 1.2, 0.5, 0
    yield 1.001, 2.0, 24  # near 1, and not 1
    for low, high in ((0.1, 0.95), (1.05, 1.5), (-0.8, -0.1)) * 2:
        a, step = rng.numbers(low, high), rng.numbers(0.1, 2)
        yield float(a), float(step), int(rng.integers(2, 12))


row.cases(
    {
        "factors below 1": lambda a, step, T: a < 1,
        "factors of 1": lambda a, step, T: a == 1,
        "factors above 1": lambda a, step, T: a > 1,
    }
)


@row.rare
def _(rng):
    yield 1.0, float(rng.numbers(0.1, 2)), int(rng.integers(2, 12))


@row.wrongs(hidden={"near-1": "the lab has no factor near 1, except 1 itself"})
def _(a, step, T):
    """always-linear: your function returns `step * T` for every a. In each step,
      multiply the previous error by a before you add `step`
    limit: your function returns `step / (1 - a)`, which is the limit of the error for
      infinitely many steps if |a| < 1. Return the sum of the first T terms of the
      geometric series instead
    limit 2: for a below 1, your function returns `step / (1 - a)`, which is the limit
      for infinitely many steps. Return the sum of the first T terms of the geometric
      series instead
    near-1: your code also uses `step * T` for values of a near 1. Use this product only
      for a = 1, and the geometric sum for all other values
    zero-at-1: your function returns 0 for a = 1. In this case each step adds `step` to
      the error, so return `step * T`
    one-error: your function returns step * a^T, as if one error were added before the
      first step. Each of the T steps adds an error, so return the sum of all T
      contributions
    one-error 2: your function returns step * a^(T - 1), which is the contribution of
      the first step only. Add the contributions of all T steps
    summed-errors: your function sums the error over all steps. Return only the error
      after the last step
    continuous: your code uses exp((a - 1) * T), which approximates a^T only for a near
      1. Each step multiplies the error by a, so use a^T instead
    step-multiplied: your code also multiplies the newly added error by a. Multiply only
      the previous error by a, and then add `step`
    """
    a = np.float64(a)
    geometric = step * np.sum(a ** np.arange(T))
    with np.errstate(all="ignore"):
        return {
            "always-linear": step * T,
            "limit": step / (1 - a),
            "limit 2": step / (1 - a) if a < 1 else geometric,
            "near-1": step * T if abs(a - 1) < 0.005 else geometric,
            "zero-at-1": geometric * (a != 1),
            "one-error": step * a**T,
            "one-error 2": step * a ** (T - 1.0),
            "summed-errors": sum(
                step * np.sum(a ** np.arange(t)) for t in range(T + 1)
            ),
            "continuous": step * np.expm1((a - 1) * T) / (a - 1)
            if a != 1
            else step * T,
            "step-multiplied": a * geometric,
        }


@row.right  # A loop.
def _(a, step, T):
    e = 0.0  # the error so far
    for _ in range(T):
        e = a * e + step
    return e


@row.right  # The sum of all powers.
def _(a, step, T):
    return step * sum(a**k for k in range(T))


row.spans(step=(1e-4,), T=(24,))


row.at_least_0(T="a number of steps")

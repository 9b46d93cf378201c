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
    """always-linear: your error grows by the same amount in each step. Each step
      also multiplies the present error by a
    limit: your function returns the limit of the error for many steps, s / (1 - a).
      Include the term with a^T, because T is finite
    limit 2: your function returns the limit of the error for many steps, s / (1 - a),
      if a is below 1. Include the term with a^T, because T is finite
    near-1: your code uses s T for factors near 1 as well. Use it for a = 1 only
    zero-at-1: your function returns 0 for a = 1. Each step adds the same error in
      this case, so return s T
    one-error: your function lets a single error grow by the factor a per step. Each
      of the T steps adds an error, so return a sum
    one-error 2: your function lets a single error grow by the factor a per step.
      Each of the T steps adds an error, so return a sum
    summed-errors: your function adds the errors of all T steps. Return the error
      after the last step
    continuous: your code uses exp((a - 1) T), which is a limit for small steps. The
      recursion multiplies by a in each step, so use a^T
    step-multiplied: your code also multiplies the new error by a. Multiply only the
      present error by a, and then add the new error
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

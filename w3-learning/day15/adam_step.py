"""15.7 `adam_step(theta, grad, m, v, k, rate)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(
    (
        Vector((None,), called="theta", scale=0.01),
        Vector((None,), called="m"),
        Vector((None,), called="v"),
    ),
    # A gradient of 0 without a past: any number divided by itself.
    at_edge=lambda theta, grad, m, v, k, rate: bool(
        np.all((np.abs(grad) > 1e-3) | (v > 1e-6))
    ),
)


def state(rng, n, k, size=1.0):
    """Return theta, a gradient, both averages after k - 1 steps, and k."""
    before = size * (k > 1)  # the averages are 0 before the first step
    return (
        rng.numbers(-1, 1, n),
        size * rng.numbers(-3, 3, n),
        before * rng.numbers(-0.5, 0.5, n),
        before**2 * rng.numbers(0.001, 0.02, n),
        k,
    )


@row.inputs
def _(rng):
    one = np.ones(1)
    yield one, 3 * one, 0 * one, 0 * one, 1, 0.01
    for n, k in ((2, 1), (3, 2), (2, 3), (4, 7), (3, 20)):
        yield *state(rng, n, k), float(rng.numbers(0.005, 0.05))
    yield *state(rng, 2, 3, 1e-6), 0.02  # a tiny gradient shows eps


row.cases(
    the_first_step=lambda theta, grad, m, v, k, rate: k == 1,
    later_steps=lambda theta, grad, m, v, k, rate: k > 1,
)


@row.wrongs
def _(theta, grad, m, v, k, rate):
    """no-correction: your code omits the bias correction of the averages m and v.
      Divide m by 1 - 0.9^k and v by 1 - 0.999^k, because both averages start at 0 and
      are therefore biased towards 0
    corrected-kept: your code returns the corrected averages. Return m and v without the
      correction, because the next step would correct them again
    eps-in-the-root: your code adds 1e-8 inside the square root. Take the square root
      first, and then add 1e-8
    betas-swapped: your code swaps the two decay rates. The decay rate of m is 0.9, and
      the decay rate of v is 0.999
    weights-swapped: your code gives the gradient a weight of 0.9 and its square a
      weight of 0.999. Give these weights to the old averages m and v instead
    weight-1: your code gives the gradient and its square a weight of 1. Use weights of
      0.1 and 0.001 instead, so that the weights in each average add up to 1
    times-for-power: your code divides the averages by 1 - 0.9 * k and 1 - 0.999 * k.
      Raise the decay rates to the power k instead
    old-averages: your code updates theta with the old averages m and v. Update m and v
      before theta
    corrections-swapped: your code divides m by 1 - 0.999^k and v by 1 - 0.9^k. Swap the
      two corrections, because m has the decay rate 0.9 and v has the decay rate 0.999
    """
    m1 = 0.9 * m + 0.1 * grad
    v1 = 0.999 * v + 0.001 * grad**2
    c1, c2 = 1 - 0.9**k, 1 - 0.999**k
    mean = m1 / c1
    square = v1 / c2

    def step(mean, square):
        return theta - rate * mean / (np.sqrt(square) + 1e-8)

    ms = 0.999 * m + 0.001 * grad
    vs = 0.9 * v + 0.1 * grad**2
    mw = 0.1 * m + 0.9 * grad
    vw = 0.001 * v + 0.999 * grad**2
    ma = 0.9 * m + grad
    va = 0.999 * v + grad**2
    right = step(mean, square)
    return {
        "no-correction": (step(m1, v1), m1, v1),
        "corrected-kept": (right, mean, square),
        "eps-in-the-root": (theta - rate * mean / np.sqrt(square + 1e-8), m1, v1),
        "betas-swapped": (step(ms / c2, vs / c1), ms, vs),
        "weights-swapped": (step(mw / c1, vw / c2), mw, vw),
        "weight-1": (step(ma / c1, va / c2), ma, va),
        "times-for-power": (step(m1 / (1 - 0.9 * k), v1 / (1 - 0.999 * k)), m1, v1),
        "old-averages": (step(m / c1, v / c2), m1, v1),
        "corrections-swapped": (step(m1 / c2, v1 / c1), m1, v1),
    }


@row.right  # The corrections in the step size, as in the paper's remark.
def _(theta, grad, m, v, k, rate):
    m = m + 0.1 * (grad - m)
    v = v + 0.001 * (grad * grad - v)
    root = np.sqrt(1 - 0.999**k)
    size = rate * root / (1 - 0.9**k)
    return theta - size * m / (np.sqrt(v) + 1e-8 * root), m, v


@row.right  # Entry by entry.
def _(theta, grad, m, v, k, rate):
    new = [np.zeros(len(theta)) for _ in range(3)]
    for i in range(len(theta)):
        a = 0.9 * m[i] + (1 - 0.9) * grad[i]
        b = 0.999 * v[i] + (1 - 0.999) * grad[i] ** 2
        move = (a / (1 - 0.9**k)) / ((b / (1 - 0.999**k)) ** 0.5 + 1e-8)
        new[0][i], new[1][i], new[2][i] = theta[i] - rate * move, a, b
    return tuple(new)


@row.spans
def _(rng):
    theta, grad, m, v, _ = state(rng, 3, 4)
    yield theta, grad, m, v, 1000, 1e-8
    for size in (1e-4, 1e3):
        yield 1e-3 * theta, size * grad, size * m, size**2 * v, 4, 0.003

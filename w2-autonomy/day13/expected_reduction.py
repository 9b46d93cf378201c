"""13.8 `expected_reduction(dV, alpha)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    one = np.array([-4.0, 2.0])
    drawn = []
    for k in range(6):
        first, second = rng.numbers(0.5, 4, 2)
        alpha = float([rng.numbers(0.1, 0.9), 1.0][k % 2])
        drawn.append((np.array([-first, second]), alpha))
    return [(one, 0.5), (one, 1.0), *drawn]


@row.wrongs
def _(dV, alpha):
    """sign: your code negates the expected reduction. The expected reduction should be
      positive if the cost is expected to fall
    alpha-rooted: your code multiplies the quadratic part by the square root of alpha.
      Multiply it by alpha^2 instead
    """
    first, second = dV
    return {
        "sign": alpha * first + alpha**2 * second,
        "alpha-rooted": -(alpha * first + np.sqrt(alpha) * second),
    }


row.at_least_0(alpha="a fraction")


@row.right  # Horner's scheme.
def _(dV, alpha):
    return -alpha * (dV[0] + alpha * dV[1])


row.spans(  # as small, or as large, as in the lab
    dV=(
        lambda dV: 0.005 * dV,
        lambda dV: 1000 * dV,
    ),
)

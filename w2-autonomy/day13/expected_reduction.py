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
    """alpha-not-squared: the second part grows with alpha squared => with alpha in both
    alpha-squared-in-both: the first part grows with alpha => with alpha^2 in both
    alpha-forgotten: alpha is missing: that is what the whole step should save => with
      alpha 1
    alpha-in-the-first-only: alpha is missing in the second part
    first-order: the second part is missing => without dV[1]
    second-part-only: the first part is missing => without dV[0]
    sign: the sign is the other way: a drop is what is saved, above 0 when all is well
      => the change of the cost
    second-sign: the second part is added to what is saved; it takes some of it back
      => with alpha^2 dV[1] added
    second-doubled: the second part is doubled; it is whole already
    alpha-in-the-second-only: alpha is missing in the first part => with dV[0] as it
      is
    halved: it is half of it: the second part has its half already
    alpha-rooted: the second part grows with alpha's root; it is alpha squared
    alpha-cubed: the second part grows with alpha to the third; it is alpha squared
    one-less-alpha: the second part is multiplied by (1 - alpha)^2; it is alpha^2
    half-again: the second part is halved once more; it has its half already
    alphas-swapped: alpha squared belongs to the second part => with alpha and its
      square swapped
    """
    first, second = dV
    return {
        "alpha-not-squared": -alpha * (first + second),
        "alpha-squared-in-both": -(alpha**2) * (first + second),
        "alpha-forgotten": -(first + second),
        "alpha-in-the-first-only": -(alpha * first + second),
        "first-order": -alpha * first,
        "second-part-only": -(alpha**2) * second,
        "sign": alpha * first + alpha**2 * second,
        "second-sign": -alpha * first + alpha**2 * second,
        "second-doubled": -(alpha * first + 2 * alpha**2 * second),
        "alpha-in-the-second-only": -(first + alpha**2 * second),
        "halved": -(alpha * first + alpha**2 * second) / 2,
        "alpha-rooted": -(alpha * first + np.sqrt(alpha) * second),
        "alpha-cubed": -(alpha * first + alpha**3 * second),
        "one-less-alpha": -(alpha * first + (1 - alpha) ** 2 * second),
        "half-again": -(alpha * first + alpha**2 * second / 2),
        "alphas-swapped": -(alpha**2 * first + alpha * second),
    }


row.at_least_0(alpha="a share")


@row.right  # Horner's way.
def _(dV, alpha):
    return -alpha * (dV[0] + alpha * dV[1])


row.spans(  # as small, or as large, as in the lab
    dV=(
        lambda dV: 0.005 * dV,
        lambda dV: 1000 * dV,
    ),
)

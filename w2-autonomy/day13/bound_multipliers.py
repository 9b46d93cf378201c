"""13.9 `bound_multipliers(H, f, lo, hi, x)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

from .asked import problems

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    one = np.ones(2)
    H = np.array([[2.0, 1], [1, 2]])
    case = (H, np.array([-2.0, -10]), -one, one, np.array([0.5, 1.0]))
    return [case, *problems(rng, 9)]


@row.wrongs
def _(H, f, lo, hi, x):
    """sign: your multipliers have the wrong sign. Each multiplier should be the
      corresponding entry of the gradient, because the cost rises if a bound moves along
      the gradient
    absolute: your code takes the absolute values of the multipliers. The multiplier of
      an upper bound should be negative, because the cost falls if this bound moves up
    upper-only: your code returns nonzero multipliers only for the upper bounds. A lower
      bound that holds an entry has a nonzero multiplier too
    lower-only: your code returns nonzero multipliers only for the lower bounds. An
      upper bound that holds an entry has a nonzero multiplier too
    no-price: your multipliers of the held entries are 0. The multiplier of a held entry
      should be the corresponding entry of the gradient
    largest-only: your code returns only the largest multiplier. Each held entry should
      have its own multiplier
    first-limit-only: your code returns a multiplier only for the first held entry. Each
      held entry should have its own multiplier
    times-the-width: your code multiplies the gradient by the distance between the
      bounds. The multiplier should be the change in the minimum cost per unit of
      movement of the bound
    lower-sign: your multipliers of the lower bounds have the wrong sign. Each
      multiplier should be the corresponding entry of the gradient
    g-forgotten: your gradient omits f. It should be H x + f
    H-halved: your gradient is H x / 2 + f. The gradient of x . H x / 2 is H x
    H-doubled: your gradient is 2 H x + f. The gradient of x . H x / 2 is H x
    divided-by-H: your code divides the gradient by the diagonal of H, which gives a
      distance. Return the gradient itself
    how-far: your result is the distance to the unconstrained minimiser. The multiplier
      should be the change in the minimum cost per unit of movement of the bound
    one-each: your result contains only the sign of each multiplier. Return the entry of
      the gradient itself
    """
    slope = H @ x + f
    low = (x <= lo) & (slope > 0)
    high = (x >= hi) & (slope < 0)
    held = low | high
    right = np.where(held, slope, 0.0)

    def at(s):
        return np.where(held, s, 0.0)

    return {
        "sign": -right,
        "absolute": np.abs(right),
        "upper-only": np.where(high, slope, 0.0),
        "lower-only": np.where(low, slope, 0.0),
        "no-price": np.where(held, 0.0, slope),
        "largest-only": np.where(np.abs(right) == np.abs(right).max(), right, 0.0),
        "first-limit-only": np.where(np.cumsum(held) == 1, right, 0.0),
        "times-the-width": at(slope * (hi - lo)),
        "lower-sign": np.where(low, -right, right),
        "g-forgotten": at(H @ x),
        "H-halved": at(H @ x / 2 + f),
        "H-doubled": at(2 * H @ x + f),
        "divided-by-H": right / np.diag(H),
        "how-far": x - np.linalg.solve(H, -f),
        "one-each": np.sign(right),
    }


BEST = (
    "at the minimiser the gradient of a free entry is 0; a held one has the right sign"
)
HELD = "held = (x <= lo) & (slope > 0) | (x >= hi) & (slope < 0) => held = "
row.same(HELD + "(x <= lo) & (slope > -0.001 + 0) | (x >= hi) & (slope < 0)", BEST)
row.same(HELD + "(x <= lo) & (slope > 0) | (x >= hi) & (slope < 0.001 + 0)", BEST)
row.same(HELD + "(x <= lo) & (slope > 0) | (x >= hi) & (slope < 1)", BEST)
row.same("first lo = np.abs(lo)", BEST)
row.same("first lo = np.maximum(lo, 0)", BEST)
row.same("first lo = np.clip(lo, -1, 1)", BEST)
row.same("first hi = np.clip(hi, -1, 1)", BEST)


@row.right  # At the best x the free ones' slopes are 0 anyway.
def _(H, f, lo, hi, x):
    return H @ x + f

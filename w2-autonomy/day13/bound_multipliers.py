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
    """sign: your code negates the multipliers. Return the entries of the gradient,
      because the minimum cost rises if a bound moves in the direction of the gradient
    absolute: your multipliers of the upper bounds are positive. They should be
      negative, because the minimum cost falls if an upper bound rises
    upper-only: your code returns multipliers only for the upper bounds. Also return
      multipliers for the lower bounds that hold an entry
    lower-only: your code returns multipliers only for the lower bounds. Also return
      multipliers for the upper bounds that hold an entry
    no-price: your code returns 0 for the held entries. Return the corresponding entry
      of the gradient for each held entry
    largest-only: your code returns only the multiplier with the largest absolute value.
      Return a multiplier for each held entry
    first-limit-only: your code returns a multiplier only for the first held entry.
      Return a multiplier for each held entry
    times-the-width: your code multiplies the gradient by the distance between the
      bounds. Return the gradient itself, which is the change in the minimum cost per
      unit change in the bound
    lower-sign: your code negates the multipliers of the lower bounds. Return the
      corresponding entries of the gradient
    g-forgotten: your code omits f in the gradient. Use H x + f
    H-halved: your code uses H x / 2 + f as the gradient. Use H x + f, because the
      gradient of x . H x / 2 is H x
    H-doubled: your code uses 2 H x + f as the gradient. Use H x + f, because the
      gradient of x . H x / 2 is H x
    divided-by-H: your code divides the gradient by the diagonal of H. Return the
      gradient itself, which is the change in the minimum cost per unit change in the
      bound
    how-far: your code returns the difference between x and the unconstrained minimiser.
      Return the gradient instead, which is the change in the minimum cost per unit
      change in the bound
    one-each: your code returns only the sign of each multiplier. Return the entry of
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

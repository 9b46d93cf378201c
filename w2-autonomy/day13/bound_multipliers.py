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
    """sign: the signs are turned round: a limit that moves along the slope costs more
      => the right one with the other sign
    absolute: the signs are lost: an upper limit that moves up saves => its sizes
    upper-only: only upper limits have a price
    lower-only: only lower limits have a price
    no-price: every price is 0, as it is where no limit holds; where one holds it is the
      slope => the slopes of the entries that no limit holds
    largest-only: only the largest price is there; each limit that holds has one
    first-limit-only: only the first limit that holds has its price; each of them has
      one
    times-the-width: the slope is multiplied by the width of the box; the limit moves by
      1
    doubled: it is twice as large
    lower-sign: a lower limit's price has the wrong sign => with minus the lower ones
    times-x: the slope is multiplied by x; the limit moves by 1, not by x
    g-forgotten: f is missing in the slope => with H x
    g-forgotten 2: f is missing in the slope => H x
    H-forgotten: H is missing in the slope => with f
    H-forgotten 2: H is missing in the slope => f
    H-halved: the slope of x . H x / 2 is H x => with H x / 2 + f
    H-doubled: the slope of x . H x / 2 is H x => with 2 H x + f
    divided-by-H: it is divided by H's diagonal: that is how far the entry would go, and
      no cost
    how-far: this is how far x would move without its limits; what the cost changes by
      is asked
    one-each: a limit that holds has a price of its own, not 1 => its sign
    halved: it is half of it
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
        "doubled": 2 * right,
        "lower-sign": np.where(low, -right, right),
        "times-x": at(slope * x),
        "g-forgotten": at(H @ x),
        "g-forgotten 2": H @ x,
        "H-forgotten": at(f),
        "H-forgotten 2": f.copy(),
        "H-halved": at(H @ x / 2 + f),
        "H-doubled": at(2 * H @ x + f),
        "divided-by-H": right / np.diag(H),
        "how-far": x - np.linalg.solve(H, -f),
        "one-each": np.sign(right),
        "halved": right / 2,
    }


BEST = "at the best x a free entry's slope is 0, and a held one's has the right sign"
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

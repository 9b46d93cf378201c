"""9.1 `quantise(q, counts)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.argument_mistakes import Change

from .signals import JOINTS

# Half-way between two counts there is no nearest one.
row = Row(
    Vector((7,), "rad", names=JOINTS, scale=0.01),
    at_edge=lambda q, counts: not np.isclose(q * counts / np.pi % 2.0, 1.0).any(),
)


@row.inputs
def _(rng):
    drawn = [rng.numbers(-3, 3, 7) for _ in range(6)]
    sizes = [4096.0, 360.0, 1000.0, 64.0, 257.0, 65536.0]
    return [(np.full(7, 0.1), 4096.0), *zip(drawn, sizes, strict=True)]


@row.wrongs
def _(q, counts):
    """floor: it is rounded down; an encoder that says the nearest count is off by half
      a count at most, and by none in the mean => the right one with floor
    ceil: it is rounded up; the nearest count is asked for => with ceil
    towards-zero: the fraction is cut off, as int() does: that rounds towards 0; the
      nearest count is asked for => with the fraction cut off
    one-count-fewer: a turn is divided by counts - 1; the last count of a turn is
      followed by the first again => with 2 pi / (counts - 1)
    half-a-turn: the counts are spread over pi; they are those of a full turn, 2 pi
    no-pi: a step is 1 / counts: q is in radians, and a full turn is 2 pi of them
    in-counts: these are counts; the angle is asked for => the right one / step
    in-degrees: a step is 360 / counts, which is in degrees; q is in radians
    rounded-twice: the answer is rounded to three decimals; the step decides alone
    not-rounded: it is q itself: nothing is rounded to whole counts => q
    """
    step = 2.0 * np.pi / counts
    return {
        "floor": np.floor(q / step) * step,
        "ceil": np.ceil(q / step) * step,
        "towards-zero": np.trunc(q / step) * step,
        "one-count-fewer": np.round(q * (counts - 1) / (2 * np.pi))
        * (2 * np.pi / (counts - 1)),
        "half-a-turn": np.round(q / step * 2) * step / 2,
        "no-pi": np.round(q * counts) / counts,
        "in-counts": np.round(q / step),
        "in-degrees": np.round(q * counts / 360) * 360 / counts,
        "rounded-twice": np.round(np.round(q / step) * step, 3),
        "not-rounded": q.copy(),
    }


row.of_argument(
    "q",
    Change(
        "wrapped",
        "q is wrapped into 0 to 2 pi first; an angle below 0 stays below 0",
        lambda q: np.mod(q, 2 * np.pi),
    ),
    Change(
        "sign-of-q-lost",
        "the sign of q is lost: what is negative counts as positive",
        np.abs,
    ),
)


@row.right  # Half a count added, then rounded down.
def _(q, counts):
    return np.floor(q * counts / (2 * np.pi) + 0.5) * 2 * np.pi / counts


row.at_least_0(counts="a number of counts")

"""9.1 `quantise(q, counts)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.argument_mistakes import Change

from .signals import JOINTS

# Halfway between two counts there is no nearest one.
row = Row(
    Vector((7,), "rad", names=JOINTS, scale=0.01),
    at_edge=lambda q, counts: not np.isclose(q * counts / np.pi % 2.0, 1.0).any(),
)


@row.inputs
def _(rng):
    drawn = [rng.numbers(-3, 3, 7) for _ in range(6)]
    sizes = [4096.0, 360.0, 1000.0, 64.0, 257.0, 65536.0]
    return [(np.full(7, 0.1), 4096.0), *zip(drawn, sizes, strict=True)]


row.spans(counts=(2.0**4, 2.0**18))


def counted(
    q, counts, *, step=lambda n: 2 * np.pi / n, whole=np.round,
    told=lambda k, step: k * step,
):  # fmt: skip
    """Return the angle with another step, another rounding or another output."""
    own = step(counts)
    return told(whole(q / own), own)


for slug, says, other in (
    ("floor",
     "your code rounds down the number of counts. Round the number of counts to the "
     "nearest integer instead, because an encoder reports the nearest count",
     {"whole": np.floor}),
    ("towards-zero",
     "your code rounds the number of counts towards 0, as int() does. Round the number "
     "of counts to the nearest integer instead, because an encoder reports the nearest "
     "count",
     {"whole": np.trunc}),
    ("middle-of-a-count",
     "your code rounds down the number of counts and adds half a count. Round the "
     "number of counts to the nearest integer instead, because an encoder reports "
     "whole counts",
     {"whole": lambda k: np.floor(k) + 0.5}),
    ("one-count-fewer",
     "your code divides a revolution by `counts - 1`. Divide the revolution by "
     "`counts` instead, because a revolution contains `counts` steps",
     {"step": lambda n: 2 * np.pi / (n - 1)}),
    ("no-pi",
     "your code sets the angle of one count to 1 / counts. Use 2 pi / counts instead, "
     "because one revolution is 2 pi radians", {"step": lambda n: 1 / n}),
    ("in-degrees",
     "your code sets the angle of one count to 360 / counts, in degrees. Use 2 pi / "
     "counts instead, because q is in radians", {"step": lambda n: 360 / n}),
    ("step-inverted",
     "your code sets the angle of one count to counts / (2 pi). Use 2 pi / counts "
     "instead, because one revolution contains `counts` counts",
     {"step": lambda n: n / (2 * np.pi)}),
    ("in-counts",
     "your code returns the number of counts. Multiply this number by the angle of one "
     "count to get an angle in radians",
     {"told": lambda k, step: k}),
    ("two-pi-alone", "your code divides the rounded number of counts by 2 pi. "
                     "Multiply this number by the angle of one count instead",
     {"told": lambda k, step: k / (2 * np.pi)}),
):  # fmt: skip
    row.wrong(slug, says)(partial(counted, **other))


@row.wrong
def the_error(q, counts):
    """your code returns the rounding error. Return the angle that the encoder reports
    instead"""
    return q - counted(q, counts)


row.of_argument(
    "q",
    Change(
        "wrapped",
        "your code wraps q to [0, 2 pi). Omit this step, because a negative angle "
        "should stay negative",
        lambda q: np.mod(q, 2 * np.pi),
    ),
)


@row.right  # Half a count is added, then np.floor.
def _(q, counts):
    return np.floor(q * counts / (2 * np.pi) + 0.5) * 2 * np.pi / counts


row.at_least_0(counts="a number of counts")


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # In int16, which ends at 32,767.
def _(q, counts):
    step = 2 * np.pi / counts
    return np.round(q / step).astype(np.int64).astype(np.int16) * step

"""9.1 `quantise(q, counts)`: its questions and its mistakes."""

from functools import partial

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


row.spans(counts=(2.0**4, 2.0**18))


def counted(
    q, counts, *, step=lambda n: 2 * np.pi / n, whole=np.round,
    told=lambda k, step: k * step,
):  # fmt: skip
    """Return the angle with other parts: of which step, rounded how, told as what."""
    own = step(counts)
    return told(whole(q / own), own)


for slug, says, redone, other in (
    ("floor", "it is rounded down; an encoder that says the nearest count is off by "
     "half a count at most, and by none in the mean", "the right one with floor",
     {"whole": np.floor}),
    ("ceil", "it is rounded up; the nearest count is asked for", "with ceil",
     {"whole": np.ceil}),
    ("towards-zero", "the fraction is cut off, as int() does: that rounds towards 0; "
     "the nearest count is asked for", "with the fraction cut off",
     {"whole": np.trunc}),
    ("middle-of-a-count", "it is rounded down, and half a count is added; the nearest "
     "count itself is asked for", "with floor and a half",
     {"whole": lambda k: np.floor(k) + 0.5}),
    ("middle-of-a-count", "it is rounded down, and half a count is taken off; the "
     "nearest count itself is asked for", "with floor less a half",
     {"whole": lambda k: np.floor(k) - 0.5}),
    ("not-rounded", "nothing is rounded to whole counts", "without rounding",
     {"whole": lambda k: k}),
    ("one-count-fewer", "a turn is divided by counts - 1; the last count of a turn is "
     "followed by the first again", "with 2 pi / (counts - 1)",
     {"step": lambda n: 2 * np.pi / (n - 1)}),
    ("one-count-more", "a turn is divided by counts + 1", "with 2 pi / (counts + 1)",
     {"step": lambda n: 2 * np.pi / (n + 1)}),
    ("half-a-turn", "the counts are spread over pi; they are those of a full turn, "
     "2 pi", "with pi / counts", {"step": lambda n: np.pi / n}),
    ("two-turns", "the counts are spread over 4 pi; they are those of one turn, 2 pi",
     "with 4 pi / counts", {"step": lambda n: 4 * np.pi / n}),
    ("no-pi", "a step is 1 / counts: q is in radians, and a full turn is 2 pi of them",
     "with 1 / counts", {"step": lambda n: 1 / n}),
    ("in-degrees", "a step is 360 / counts, which is in degrees; q is in radians",
     "with 360 / counts", {"step": lambda n: 360 / n}),
    ("step-inverted", "a step is counts / (2 pi); it is 2 pi / counts",
     "with counts / (2 pi)", {"step": lambda n: n / (2 * np.pi)}),
    ("in-counts", "these are counts; the angle is asked for", "the right one / step",
     {"told": lambda k, step: k}),
    ("two-pi-alone", "the counts are divided by 2 pi; a count is 2 pi / counts",
     "counts / (2 pi)", {"told": lambda k, step: k / (2 * np.pi)}),
    ("divided-by-the-step", "the counts are divided by the step once more; times the "
     "step they are an angle", "the right one / step^2",
     {"told": lambda k, step: k / step}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(counted, **other))


@row.wrongs
def _(q, counts):
    """rounded-twice: the answer is rounded to three decimals; the step decides alone
    the-error: it is how far off an encoder is; asked for is what it says => q less the
      right one
    """
    right = counted(q, counts)
    return {"rounded-twice": np.round(right, 3), "the-error": q - right}


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


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # In int16, which ends at 32,767.
def _(q, counts):
    step = 2 * np.pi / counts
    return np.round(q / step).astype(np.int64).astype(np.int16) * step

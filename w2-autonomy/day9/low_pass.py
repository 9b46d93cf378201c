"""9.3 `low_pass(x, dt, cutoff)`: its questions and its mistakes."""

import itertools
from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from robo47.estimation import low_pass

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    drawn = []
    for k in range(6):
        x = rng.numbers(-2, 2, [5, 8, 12][k % 3])
        drawn.append((x, [0.002, 0.004][k % 2], float(rng.numbers(5, 80))))
    # Slow enough that alpha without dt is not 1 to all digits.
    slow = (rng.numbers(-2, 2, 8), 0.5, float(rng.numbers(0.05, 0.3)))
    return [(np.array([0.0, 1.0, 1.0, 1.0]), 0.002, 20.0), *drawn, slow]


@row.spans
def _(rng):
    for cutoff in (0.1, 1.0, 250.0):
        yield rng.numbers(-2, 2, 8), 0.002, cutoff


def share(x):
    """Return alpha from x = 2 pi cutoff dt."""
    return 1 - np.exp(-x)


def filtered(
    x, dt, cutoff, *, of=lambda dt, f: 2 * np.pi * f * dt, alpha=share,
    first=lambda x, alpha: x[0], step=lambda y, now, before, a: y + a * (now - y),
):  # fmt: skip
    """Return y with another exponent, alpha, first output or step."""
    a = alpha(of(dt, cutoff))
    y = [first(x, a)]
    for before, now in itertools.pairwise(x):
        y.append(step(y[-1], now, before, a))
    return np.array(y)


for slug, says, other in (
    ("rc-share",
     "your code uses dt / (dt + RC) as alpha, where RC is 1 / (2 pi cutoff). Use 1 - "
     "exp(-dt / RC) instead, because your formula is an approximation for a dt that is "
     "much smaller than RC",
     {"alpha": lambda x: x / (1 + x)}),
    ("share-turned-round",
     "in your result, the weights alpha and 1 - alpha are swapped. The new sample "
     "should get the weight alpha = 1 - exp(-2 pi cutoff dt), and the previous output "
     "the weight 1 - alpha",
     {"step": lambda y, now, before, a: now + a * (y - now)}),
    ("euler-share",
     "your code uses 2 pi cutoff dt as alpha, which can exceed 1. Use 1 - exp(-2 pi "
     "cutoff dt) instead, because it is always below 1",
     {"alpha": lambda x: x}),
    ("no-2-pi",
     "your code omits the factor of 2 pi in alpha. The weight alpha should be 1 - "
     "exp(-2 pi cutoff dt), because `cutoff` is in Hz",
     {"of": lambda dt, f: f * dt}),
    ("cutoff-for-time",
     "your code uses `cutoff` as the time constant. Use 1 / (2 pi cutoff) instead, "
     "because `cutoff` is a frequency in Hz", {"of": lambda dt, f: dt / f}),
    ("two-for-e",
     "your code computes alpha with a power of 2 instead of the exponential function. "
     "The weight alpha should be 1 - exp(-2 pi cutoff dt)",
     {"alpha": lambda x: 1 - 2.0**-x}),
    ("from-zero",
     "your code starts the output at 0. Start the output at x[0] instead",
     {"first": lambda x, a: 0.0}),
    ("first-filtered",
     "your code starts the output at alpha x[0]. Start the output at x[0] instead",
                       {"first": lambda x, a: a * x[0]}),
    ("by-the-sample-before", "your code uses the previous sample of x instead of the "
                             "previous output. Use the previous output, because it "
                             "depends on all earlier samples",
     {"step": lambda y, now, before, a: a * now + (1 - a) * before}),
    ("change-added",
     "your code adds alpha times the change of x since the previous sample. Add alpha "
     "times the difference between x and the previous output instead",
     {"step": lambda y, now, before, a: y + a * (now - before)}),
    ("whole-numbers-kept",
     "your outputs have no fractional part, as in an integer array. Keep the "
     "fractional part of each output",
     {"step": lambda y, now, before, a: np.trunc(np.trunc(y) + a * (now - np.trunc(y))),
      "first": lambda x, a: np.trunc(x[0])}),
):  # fmt: skip
    row.wrong(slug, says)(partial(filtered, **other))


@row.wrongs
def _(x, dt, cutoff):
    """backwards: your code filters from the last sample to the first, so it uses
      samples that are not known yet. Begin with the first sample
    there-and-back: your code filters forwards and then backwards, as filtfilt does.
      Omit the backward pass, because it uses samples that are not known yet
    what-is-fast: your code returns x - y, which is the output of a high-pass filter.
      Return y itself instead
    not-filtered: your function returns x unchanged. Return the filtered signal y
      instead
    last-left-out: your code returns 0 as the last output. Filter the last sample too,
      because y has one output for each sample
    last-left-out 2: your code returns the unfiltered last sample as the last output.
      Filter the last sample too
    """
    right = low_pass(x, dt, cutoff)
    return {
        "backwards": filtered(x[::-1], dt, cutoff)[::-1],
        "there-and-back": filtered(right[::-1], dt, cutoff)[::-1],
        "what-is-fast": x - right,
        "not-filtered": x.copy(),
        "last-left-out": np.append(right[:-1], 0.0),
        "last-left-out 2": np.append(right[:-1], x[-1]),
    }


@row.right  # The weighted sum of all samples so far.
def _(x, dt, cutoff):
    keep = np.exp(-2 * np.pi * cutoff * dt)
    y = []
    for k in range(len(x)):
        weights = (1 - keep) * keep ** np.arange(k, -1, -1.0)
        weights[0] = keep**k
        y.append(weights @ x[: k + 1])
    return np.array(y)


row.at_least_0(cutoff="a frequency", dt="a time")


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # alpha is 0.05 at least.
def _(x, dt, cutoff):
    return filtered(x, dt, cutoff, alpha=lambda x: max(share(x), 0.05))

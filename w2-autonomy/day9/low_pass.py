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
    """Return alpha of 2 pi cutoff dt."""
    return 1 - np.exp(-x)


def filtered(
    x, dt, cutoff, *, of=lambda dt, f: 2 * np.pi * f * dt, alpha=share,
    first=lambda x, alpha: x[0], step=lambda y, now, before, a: y + a * (now - y),
):  # fmt: skip
    """Return y with other parts: the share of what, from which start, which step."""
    a = alpha(of(dt, cutoff))
    y = [first(x, a)]
    for before, now in itertools.pairwise(x):
        y.append(step(y[-1], now, before, a))
    return np.array(y)


for slug, says, redone, other in (
    ("rc-share", "alpha is dt / (dt + RC), which only comes near to 1 - e^(-dt / RC) "
     "at low cutoffs", "with alpha = dt / (dt + RC)", {"alpha": lambda x: x / (1 + x)}),
    ("share-turned-round", "alpha and 1 - alpha are swapped: the old answer gets the "
     "new sample's weight", "with e^(-2 pi cutoff dt) for alpha",
     {"step": lambda y, now, before, a: now + a * (y - now)}),
    ("euler-share", "alpha is 2 pi cutoff dt, a step of Euler's; over 1 it would "
     "overshoot", "with alpha = 2 pi cutoff dt", {"alpha": lambda x: x}),
    ("no-2-pi", "the cutoff is in Hz, and a time constant is 1 / (2 pi cutoff)",
     "without 2 pi", {"of": lambda dt, f: f * dt}),
    ("half-of-2-pi", "there is pi where 2 pi is right: the cutoff is in full turns a "
     "second", "with pi cutoff dt", {"of": lambda dt, f: np.pi * f * dt}),
    ("dt-forgotten", "dt is missing in alpha: the share hangs on how long a sample "
     "takes", "with alpha = 1 - e^(-2 pi cutoff)", {"of": lambda dt, f: 2 * np.pi * f}),
    ("dt-divided", "the cutoff is divided by dt; over many short samples the shares "
     "get small, so it is multiplied", "with 2 pi cutoff / dt",
     {"of": lambda dt, f: 2 * np.pi * f / dt}),
    ("cutoff-for-time", "the cutoff is taken for a time constant",
     "alpha = 1 - e^(-dt / cutoff)", {"of": lambda dt, f: dt / f}),
    ("cutoff-divided", "dt is divided by the cutoff; a higher cutoff follows faster, "
     "so it is multiplied", "with 2 pi dt / cutoff",
     {"of": lambda dt, f: 2 * np.pi * dt / f}),
    ("time-constant-inverted", "the time constant is 2 pi cutoff; it is 1 / (2 pi "
     "cutoff), so dt is multiplied by 2 pi cutoff", "with dt / (2 pi cutoff)",
     {"of": lambda dt, f: dt / (2 * np.pi * f)}),
    ("sign-in-the-exponent", "the exponent has the wrong sign: alpha is then below 0, "
     "and y runs away from x", "with 1 - e^(2 pi cutoff dt)",
     {"alpha": lambda x: 1 - np.exp(x)}),
    ("two-for-e", "2 stands in the place of e", "with 1 - 2^(-2 pi cutoff dt)",
     {"alpha": lambda x: 1 - 2.0**-x}),
    ("2-pi-divided", "cutoff dt is divided by 2 pi; a turn has 2 pi radians, so it is "
     "multiplied", "with cutoff dt / (2 pi)", {"of": lambda dt, f: f * dt / 2 / np.pi}),
    ("from-zero", "y begins at 0, so the first numbers climb from there; it begins at "
     "x_0", "with y_0 = 0", {"first": lambda x, a: 0.0}),
    ("first-filtered", "y begins at alpha x_0, as if 0 stood before; it begins at x_0",
     "with y_0 = alpha x_0", {"first": lambda x, a: a * x[0]}),
    ("a-sample-late", "each answer is made with the sample before: it is a sample "
     "later than it need be", "with x_(k-1)",
     {"step": lambda y, now, before, a: y + a * (before - y)}),
    ("by-the-sample-before", "y_(k-1) is replaced by x_(k-1): only two samples are "
     "mixed, and nothing is remembered", "alpha x_k + (1 - alpha) x_(k-1)",
     {"step": lambda y, now, before, a: a * now + (1 - a) * before}),
    ("change-added", "alpha times the change of x is added; it is alpha times what is "
     "left from y to x", "y + alpha (x_k - x_(k-1))",
     {"step": lambda y, now, before, a: y + a * (now - before)}),
    ("share-added", "alpha x is added to y, of which nothing is taken away",
     "y + alpha x_k", {"step": lambda y, now, before, a: y + a * now}),
    ("whole-numbers-kept", "y is kept in an array of whole numbers, which cuts each "
     "step's fraction off", "cut to whole numbers at each step",
     {"step": lambda y, now, before, a: np.trunc(np.trunc(y) + a * (now - np.trunc(y))),
      "first": lambda x, a: np.trunc(x[0])}),
    ("away-from-x", "y moves away from the sample: it is y - x that is added",
     "y + alpha (y - x_k)", {"step": lambda y, now, before, a: y + a * (y - now)}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(filtered, **other))


@row.wrongs
def _(x, dt, cutoff):
    """backwards: it runs from the end to the start, so it uses what is not there yet
    there-and-back: it runs forwards and back, as filtfilt does; the way back uses what
      is not there yet
    what-is-fast: it is x - y, what the filter takes away
    not-filtered: it is x itself => x
    last-left-out: the last is 0: the loop ends one too early
    last-left-out 2: the last is x itself: the loop ends one too early => with x at the
      end
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


@row.right  # The sum of all samples so far, each with its weight.
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

"""9.1 `backward_difference(q, dt)`: its questions and its mistakes."""

import itertools
from functools import partial

import numpy as np

from labkit.judge import Row, Vector

from .signals import signals

row = Row(Vector((None,), "rad/s", scale=10.0))


@row.inputs
def _(rng):
    return [(np.array([0.0, 0.1, 0.3]), 0.1), *signals(rng)]


def backward(q):
    """Return the change since the sample before, (n,); 0 at first."""
    return np.append(0.0, np.diff(q))


def velocity(q, dt, *, change):
    """Return the velocity made of another change."""
    return change(q) / dt


for slug, says, redone, other in (
    ("forward", "each velocity uses the next sample, which is not known yet. Use the "
     "previous sample", "(q_(k+1) - q_k) / dt with 0 at the end",
     {"change": lambda q: np.append(np.diff(q), 0.0)}),
    ("forward", "each velocity uses the next sample, which is not known yet. Use the "
     "previous sample", "(q_(k+1) - q_k) / dt with the last one repeated",
     {"change": lambda q: np.append(np.diff(q), np.diff(q)[-1])}),
    ("forward", "each velocity uses the next sample, which is not known yet. Use the "
     "previous sample", "(q_(k+1) - q_k) / dt with q_n = 0",
     {"change": lambda q: np.diff(q, append=0.0)}),
    ("central", "your function returns the central difference, which uses the next "
     "sample; the next sample is not known yet", "np.gradient",
     {"change": np.gradient}),
    ("central", "your function returns the central difference, which uses the next "
     "sample; the next sample is not known yet", "np.gradient with 0 as the first "
     "velocity",
     {"change": lambda q: np.append(0.0, np.gradient(q)[1:])}),
    ("from-zero", "the first velocity is q_0 / dt, as if a sample of 0 preceded it. No "
     "sample precedes the first one, so the first velocity should be 0", "q_(-1) = 0",
     {"change": lambda q: np.diff(q, prepend=0.0)}),
    ("round-the-corner", "the first velocity uses the last sample, as np.roll does. No "
     "sample precedes the first one, so the first velocity should be 0", "np.roll",
     {"change": lambda q: q - np.roll(q, 1)}),
    ("first-repeated", "the first velocity repeats the second. No sample precedes the "
     "first one, so the first velocity should be 0", "the second velocity as the first",
     {"change": lambda q: np.append(np.diff(q)[:1], np.diff(q))}),
    ("two-samples", "the change over two samples is divided by one dt. Use the change "
     "since the previous sample", "(q_k - q_(k-2)) / dt",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2])}),
    ("mean-of-two", "the change over two samples is divided by 2 dt, which is the "
     "velocity one sample ago. Use the change since the previous sample",
     "(q_k - q_(k-2)) / (2 dt)",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2]) / 2}),
    ("since-the-start", "the result is the mean velocity since the first sample. Use "
     "the change since the previous sample", "(q_k - q_0) / (k dt)",
     {"change": lambda q: (q - q[0]) / np.maximum(np.arange(len(q)), 1)}),
    ("from-the-first", "the change since the first sample is divided by dt. Use the "
     "change since the previous sample", "(q_k - q_0) / dt",
     {"change": lambda q: q - q[0]}),
    ("by-its-time", "each change is divided by the time k dt since the start; the "
     "change happened during one dt", "(q_k - q_(k-1)) / (k dt)",
     {"change": lambda q: backward(q) / np.maximum(np.arange(len(q)), 1)}),
    ("last-left-out", "the last velocity is 0: does your loop end one sample too "
     "early?", "0 as the last velocity",
     {"change": lambda q: np.append(backward(q)[:-1], 0.0)}),
    ("second-left-out", "the second velocity is 0: does your loop begin one sample too "
     "late?", "0 as the second velocity",
     {"change": lambda q: np.append([0.0, 0.0], np.diff(q)[1:])}),
    ("twice", "the difference is taken twice, which gives an acceleration times dt",
     "the difference of the difference", {"change": lambda q: backward(backward(q))}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(velocity, **other))


@row.right  # One sample after the other, in a loop.
def _(q, dt):
    found = [0.0]
    for before, now in itertools.pairwise(q):
        found.append((now - before) / dt)
    return found


row.at_least_0(dt="a time")


row.spans(  # as small, or as large, as in the lab
    dt=(0.002,),
)

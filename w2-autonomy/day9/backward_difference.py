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


def speed(q, dt, *, change=backward, per=lambda dt: 1 / dt, told=lambda v: v):
    """Return the speed with other parts: of which change, per what."""
    return told(change(q) * per(dt))


for slug, says, redone, other in (
    ("forward", "each speed is made with the sample after it, which is not there yet; "
     "the last one is 0 and the first is not", "(q_(k+1) - q_k) / dt",
     {"change": lambda q: np.append(np.diff(q), 0.0)}),
    ("forward", "each speed is made with the sample after it, which is not there yet; "
     "the last one is repeated", "(q_(k+1) - q_k) / dt, the last one twice",
     {"change": lambda q: np.append(np.diff(q), np.diff(q)[-1])}),
    ("forward", "each speed is made with the sample after it, which is not there yet; "
     "after the last one there is a 0", "(q_(k+1) - q_k) / dt, with q_n = 0",
     {"change": lambda q: np.diff(q, append=0.0)}),
    ("central", "it is the mean of before and after, as by np.gradient; the sample "
     "after is not there yet", "np.gradient", {"change": np.gradient}),
    ("central", "it is the mean of before and after, as by np.gradient, 0 at first; "
     "the sample after is not there yet", "np.gradient, 0 at first",
     {"change": lambda q: np.append(0.0, np.gradient(q)[1:])}),
    ("from-zero", "before the first sample there is a 0: the first speed is q_0 / dt; "
     "it is 0, since nothing is known before", "with q_(-1) = 0",
     {"change": lambda q: np.diff(q, prepend=0.0)}),
    ("round-the-corner", "before the first sample stands the last, as by np.roll; the "
     "first speed is 0", "with q_(-1) = q_(n-1)",
     {"change": lambda q: q - np.roll(q, 1)}),
    ("first-repeated", "the first speed is that of the second; it is 0", "with it",
     {"change": lambda q: np.append(np.diff(q)[:1], np.diff(q))}),
    ("two-samples", "it is the change over two samples, divided by one dt",
     "(q_k - q_(k-2)) / dt",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2])}),
    ("mean-of-two", "it is the change over two samples, divided by 2 dt: that is the "
     "speed of a sample ago", "(q_k - q_(k-2)) / (2 dt)",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2]) / 2}),
    ("since-the-start", "it is the mean speed since the first sample; the sample "
     "before is enough", "(q_k - q_0) / (k dt)",
     {"change": lambda q: (q - q[0]) / np.maximum(np.arange(len(q)), 1)}),
    ("from-the-first", "it is the change since the first sample; since the sample "
     "before it is the speed", "(q_k - q_0) / dt", {"change": lambda q: q - q[0]}),
    ("by-its-time", "each change is divided by its own time, k dt; it took one dt",
     "(q_k - q_(k-1)) / (k dt)",
     {"change": lambda q: backward(q) / np.maximum(np.arange(len(q)), 1)}),
    ("last-left-out", "the last speed is 0: the loop ends one too early", "with 0",
     {"change": lambda q: np.append(backward(q)[:-1], 0.0)}),
    ("second-left-out", "the second speed is 0: the loop begins one too late", "with 0",
     {"change": lambda q: np.append([0.0, 0.0], np.diff(q)[1:])}),
    ("twice", "it is the difference of the difference: an acceleration, times dt",
     "the difference of it", {"change": lambda q: backward(backward(q))}),
    ("not-divided", "it is not divided by dt: that is an angle", "without dt",
     {"per": lambda dt: 1.0}),
    ("times-dt", "it is multiplied by dt; a speed is an angle divided by a time",
     "times dt", {"per": lambda dt: dt}),
    ("half-speed", "it is divided by 2 dt, as a central difference is", "with 2 dt",
     {"per": lambda dt: 0.5 / dt}),
    ("dt-squared", "it is divided by dt twice; that belongs to an acceleration",
     "with dt^2", {"per": lambda dt: 1 / dt**2}),
    ("sign", "it is the sample before minus this one; the speed is positive where q "
     "grows", "with the other sign", {"told": np.negative}),
    ("size-only", "its sign is lost: where q falls the speed is negative", "its size",
     {"told": np.abs}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(speed, **other))


@row.right  # A sample at a time.
def _(q, dt):
    found = [0.0]
    for before, now in itertools.pairwise(q):
        found.append((now - before) / dt)
    return found


row.at_least_0(dt="a time")


row.spans(  # as small, or as large, as in the lab
    dt=(0.002,),
)

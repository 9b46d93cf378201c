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


for slug, says, other in (
    ("forward", "your code computes velocities from the next sample, which is not "
                "known yet. Use the previous sample instead",
     {"change": lambda q: np.append(np.diff(q), 0.0)}),
    ("forward", "your code computes velocities from the next sample, which is not "
                "known yet. Use the previous sample instead",
     {"change": lambda q: np.append(np.diff(q), np.diff(q)[-1])}),
    ("forward", "your code computes velocities from the next sample, which is not "
                "known yet. Use the previous sample instead",
     {"change": lambda q: np.diff(q, append=0.0)}),
    ("central",
     "your function returns the central difference, which needs the next sample. Use "
     "the current and the previous sample instead, because the next sample is not "
     "known yet",
     {"change": np.gradient}),
    ("central",
     "your function returns the central difference, which needs the next sample. Use "
     "the current and the previous sample instead, because the next sample is not "
     "known yet",
     {"change": lambda q: np.append(0.0, np.gradient(q)[1:])}),
    ("from-zero",
     "your code returns q[0] / dt as the first velocity. The first velocity should be "
     "0, because no sample precedes the first one",
     {"change": lambda q: np.diff(q, prepend=0.0)}),
    ("round-the-corner",
     "your code computes the first velocity from the last sample, as np.roll does. The "
     "first velocity should be 0, because no sample precedes the first one",
     {"change": lambda q: q - np.roll(q, 1)}),
    ("first-repeated",
     "your code copies the second velocity to the first one. The first velocity should "
     "be 0, because no sample precedes the first one",
     {"change": lambda q: np.append(np.diff(q)[:1], np.diff(q))}),
    ("two-samples", "your code divides the change over two sampling periods by dt. "
                    "Divide the change since the previous sample by dt instead",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2])}),
    ("mean-of-two",
     "your code divides the change over two sampling periods by 2 dt. Divide the "
     "change since the previous sample by dt instead",
     {"change": lambda q: np.append([0.0, 0.0], q[2:] - q[:-2]) / 2}),
    ("since-the-start",
     "your code returns the mean velocity since the first sample. Divide the change "
     "since the previous sample by dt instead",
     {"change": lambda q: (q - q[0]) / np.maximum(np.arange(len(q)), 1)}),
    ("from-the-first", "your code divides the change since the first sample by dt. "
                       "Use the change since the previous sample instead",
     {"change": lambda q: q - q[0]}),
    ("by-its-time",
     "your code divides each change by the time since the start. Divide each change by "
     "dt instead, because each change takes place within one sampling period",
     {"change": lambda q: backward(q) / np.maximum(np.arange(len(q)), 1)}),
    ("last-left-out",
     "your code returns 0 as the last velocity. Use the last two samples for this "
     "velocity",
     {"change": lambda q: np.append(backward(q)[:-1], 0.0)}),
    ("second-left-out",
     "your code returns 0 as the second velocity. Only the first velocity should be 0, "
     "because the second sample already has a previous one",
     {"change": lambda q: np.append([0.0, 0.0], np.diff(q)[1:])}),
    ("twice",
     "your result is the difference of the differences, which is an acceleration times "
     "dt. Take the difference only once",
     {"change": lambda q: backward(backward(q))}),
):  # fmt: skip
    row.wrong(slug, says)(partial(velocity, **other))


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

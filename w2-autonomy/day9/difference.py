"""9.1 `difference(q, dt)`: its questions and its mistakes."""

import itertools

import numpy as np

from labkit.judge import Row, Vector
from robo47.estimation import difference

from .signals import signals

row = Row(Vector((None,), "rad/s", scale=10.0))


@row.inputs
def _(rng):
    return [(np.array([0.0, 0.1, 0.3]), 0.1), *signals(rng)]


@row.wrongs
def _(q, dt):
    """forward: each speed is made with the sample after it, which is not there yet; the
      last one is 0 and the first is not => (q_(k+1) - q_k) / dt
    central: it is the mean of before and after, as by np.gradient; the sample after is
      not there yet => np.gradient
    from-zero: before the first sample there is a 0: the first speed is q_0 / dt; it is
      0, since nothing is known before => with q_(-1) = 0
    round-the-corner: before the first sample stands the last, as by np.roll; the first
      speed is 0 => with q_(-1) = q_(n-1)
    first-repeated: the first speed is that of the second; it is 0
    not-divided: it is not divided by dt: that is an angle
    times-dt: it is multiplied by dt; a speed is an angle divided by a time
    sign: it is the sample before minus this one; the speed is positive where q grows
    two-samples: it is the change over two samples, divided by one dt
    half-speed: it is divided by 2 dt, as a central difference is
    mean-of-two: it is the change over two samples, divided by 2 dt: that is the speed
      of a sample ago => (q_k - q_(k-2)) / (2 dt)
    since-the-start: it is the mean speed since the first sample; the sample before is
      enough => (q_k - q_0) / (k dt)
    last-left-out: the last speed is 0: the loop ends one too early
    """
    right = difference(q, dt)
    return {
        "forward": np.append(right[1:], 0.0),
        "central": np.gradient(q, dt),
        "from-zero": np.diff(q, prepend=0.0) / dt,
        "round-the-corner": (q - np.roll(q, 1)) / dt,
        "first-repeated": np.append(right[1:2], right[1:]),
        "not-divided": right * dt,
        "times-dt": right * dt * dt,
        "sign": -right,
        "two-samples": np.append([0.0, 0.0], q[2:] - q[:-2]) / dt,
        "half-speed": right / 2,
        "mean-of-two": np.append([0.0, 0.0], q[2:] - q[:-2]) / (2 * dt),
        "since-the-start": (q - q[0]) / (dt * np.maximum(np.arange(len(q)), 1)),
        "last-left-out": np.append(right[:-1], 0.0),
    }


@row.right  # A sample at a time.
def _(q, dt):
    found = [0.0]
    for before, now in itertools.pairwise(q):
        found.append((now - before) / dt)
    return found


row.at_least_0(dt="a time")

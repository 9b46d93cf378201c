"""9.3 `low_pass(x, dt, cutoff)`: its questions and its mistakes."""

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
    return [(np.array([0.0, 1.0, 1.0, 1.0]), 0.002, 20.0), *drawn]


def run(x, alpha, first=None):
    """Return y of another share, or from another start."""
    y = [x[0] if first is None else first]
    for now in x[1:]:
        y.append(y[-1] + alpha * (now - y[-1]))
    return np.array(y)


@row.wrongs
def _(x, dt, cutoff):
    """rc-share: alpha is dt / (dt + RC), which only comes near to 1 - e^(-dt / RC) at
      low cutoffs => with alpha = dt / (dt + RC)
    no-2-pi: the cutoff is in Hz, and a time constant is 1 / (2 pi cutoff) => without
      2 pi
    share-turned-round: alpha and 1 - alpha are swapped: the old answer gets the new
      sample's weight
    euler-share: alpha is 2 pi cutoff dt, a step of Euler's; over 1 it would overshoot
      => with alpha = 2 pi cutoff dt
    from-zero: y begins at 0, so the first numbers climb from there; it begins at x_0
      => with y_0 = 0
    first-filtered: y begins at alpha x_0, as if 0 stood before; it begins at x_0
    a-sample-late: each answer is made with the sample before: it is a sample later than
      it need be => with x_(k-1)
    cutoff-for-time: the cutoff is taken for a time constant => alpha = 1 - e^(-dt /
      cutoff)
    backwards: it runs from the end to the start, so it uses what is not there yet
    there-and-back: it runs forwards and back, as filtfilt does; the way back uses what
      is not there yet
    by-the-sample-before: y_(k-1) is replaced by x_(k-1): only two samples are mixed,
      and nothing is remembered => alpha x_k + (1 - alpha) x_(k-1)
    what-is-fast: it is x - y, what the filter takes away
    not-filtered: it is x itself => x
    """
    f = 2 * np.pi * cutoff * dt
    alpha = 1 - np.exp(-f)
    right = low_pass(x, dt, cutoff)
    return {
        "rc-share": run(x, f / (1 + f)),
        "no-2-pi": run(x, 1 - np.exp(-cutoff * dt)),
        "share-turned-round": run(x, 1 - alpha),
        "euler-share": run(x, f),
        "from-zero": run(x, alpha, 0.0),
        "first-filtered": run(x, alpha, alpha * x[0]),
        "a-sample-late": run(np.append(x[:1], x[:-1]), alpha),
        "cutoff-for-time": run(x, 1 - np.exp(-dt / cutoff)),
        "backwards": run(x[::-1], alpha)[::-1],
        "there-and-back": run(right[::-1], alpha)[::-1],
        "by-the-sample-before": np.append(x[0], alpha * x[1:] + (1 - alpha) * x[:-1]),
        "what-is-fast": x - right,
        "not-filtered": x.copy(),
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

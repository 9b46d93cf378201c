"""17.10 `ema(slow, fast, k)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), called="the average"))


@row.inputs
def _(rng):
    yield np.array([1.0]), np.array([2.0]), 0
    for n, k in (
        (3, 1),
        (2, 4),
        (4, 30),
        (3, 500),
        (2, 1789),
        (3, 1792),
        (2, 3000),
        (3, 50000),
    ):
        yield rng.numbers(-2, 2, n), rng.numbers(-2, 2, n), k


row.cases(
    early_averages=lambda slow, fast, k: (1 + k) / (10 + k) < 0.995,
    late_averages=lambda slow, fast, k: (1 + k) / (10 + k) >= 0.995,
)


row.at_least_0(k="a number of averages")


@row.wrongs
def _(slow, fast, k):
    """max-for-min: your decay is the larger of 0.995 and (1 + k) / (10 + k). It is the
      smaller one, so that the first averages forget the start quickly
    always-0995: your decay is always 0.995, so the start keeps a large weight for
      hundreds of steps
    never-0995: your decay has no upper limit, so the average becomes slower and slower.
      Limit it to 0.995
    average-before: your decay is k / (9 + k), the decay of one average before. The
      first average has k = 0 and the decay 1 / 10, so it is (1 + k) / (10 + k)
    decay-0: your result is the new parameters, because the decay is 0. It is the
      fraction (1 + k) / (10 + k), which // rounds down to 0
    plain-mean 2: your old average has the weight k / (k + 1), as in the mean of all new
      parameters. Its weight is (1 + k) / (10 + k)
    plain-mean: your result is the mean of all parameters so far, which never forgets
      the start
    """
    grows = (1 + k) / (10 + k)

    def by(decay):
        return decay * slow + (1 - decay) * fast

    return {
        "max-for-min": by(max(0.995, grows)),
        "always-0995": by(0.995),
        "never-0995": by(grows),
        "average-before": by(min(0.995, k / (9 + k))),
        "decay-0": by(0),
        "plain-mean 2": by(min(0.995, k / (k + 1))),
        "plain-mean": by((k + 1) / (k + 2)),
    }


@row.right  # A step from the old average towards the new parameters.
def _(slow, fast, k):
    return slow + max(0.005, 9 / (10 + k)) * (fast - slow)


@row.spans
def _(rng):
    for size in (1e-4, 1e3):
        yield size * rng.numbers(-1, 1, 3), size * rng.numbers(-1, 1, 3), 40

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
    """max-for-min: your code uses the larger of 0.995 and (1 + k) / (10 + k) as the
      weight of the old average. Use the smaller number instead, so that the weight of
      the initial parameters decreases quickly
    always-0995: your code always gives the old average the weight 0.995. Use (1 + k) /
      (10 + k) if this number is smaller, so that the weight of the initial parameters
      decreases quickly
    never-0995: your code does not limit the weight of the old average. Limit this
      weight to 0.995, because otherwise the average follows the new parameters more and
      more slowly
    average-before: your code uses k / (9 + k) as the weight of the old average. Use (1
      + k) / (10 + k) instead, so that this weight is 1 / 10 in the first call, where k
      = 0
    decay-0: your function returns the new parameters, so the weight of the old average
      is 0. Compute this weight as (1 + k) / (10 + k), with `/` and not with `//`
    plain-mean 2: your code uses k / (k + 1) as the weight of the old average, as in the
      mean of all new parameters. Use the weight (1 + k) / (10 + k) instead, but at most
      0.995
    plain-mean: your function returns the mean of all parameters so far, because your
      code gives the old average the weight (k + 1) / (k + 2). Use the weight (1 + k) /
      (10 + k) instead, but at most 0.995
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

"""14.9 `paired_difference(first, second)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((2,), names=("the mean", "the sigma")))


@row.inputs
def _(rng):
    yield np.array([True, True, False, True]), np.array([True, False, False, False])
    yield np.arange(100) < 80, np.arange(100) < 25
    yield np.arange(20) < 5, np.arange(20) >= 12
    for n, p, q in ((10, 0.8, 0.3), (40, 0.3, 0.7), (60, 0.9, 0.5), (25, 0.5, 0.5)):
        both = rng.uniform(size=n)
        yield both < p, np.where(rng.uniform(size=n) < 0.6, both, both[::-1]) < q
    for n in (5, 12, 30):
        yield rng.numbers(-1, 1, n), rng.numbers(-1, 1, n)


@row.wrongs
def _(first, second):
    """unpaired: the variances of the two are added, as if the cubes were others; sigma
      is that of the differences
    unpaired-rates: sigma is that of two shares, p (1 - p) / n each; the cubes are the
      same
    sign: it is the second less the first
    size-only: the mean has lost its sign
    without-root-n: the sigma is not divided by sqrt(n): it is that of one cube
    over-n: the sigma is divided by n; by its root
    n-minus-one: the standard deviation is over n - 1; over n was asked for
    n-minus-one 2: the spread is divided by sqrt(n - 1); by sqrt(n)
    variance: it is the variance of the mean, not its root
    root-of-the-mean-square: sigma is taken about 0, not about the mean => with the mean
      square of the differences
    interval: sigma is 1.96 times that; that would be half of the interval
    of-the-first: it is the mean and sigma of the first alone
    sum: it is the sum of the differences, not their mean
    sizes-of-the-differences: the differences have lost their signs
    which-differ: it is the share of the cubes on which the two differ
    sorted: the two lists are sorted first, so the cubes are not the same any more
    """
    a = np.asarray(first, float)
    b = np.asarray(second, float)
    n = len(a)
    d = a - b
    mean = d.mean()
    root = np.sqrt(n)
    s = d.std()
    p, q = a.mean(), b.mean()
    ordered = np.sort(a) - np.sort(b)

    def both(m, sigma):
        return np.array([m, sigma])

    return {
        "unpaired": both(mean, np.sqrt((a.var() + b.var()) / n)),
        "unpaired-rates": lambda: both(
            mean, np.sqrt(max(p * (1 - p) + q * (1 - q), 0.0) / n)
        ),
        "sign": both(-mean, s / root),
        "size-only": both(abs(mean), s / root),
        "without-root-n": both(mean, s),
        "over-n": both(mean, s / n),
        "n-minus-one": both(mean, d.std(ddof=1) / root),
        "n-minus-one 2": both(mean, s / np.sqrt(n - 1)),
        "variance": both(mean, s**2 / n),
        "root-of-the-mean-square": both(mean, np.sqrt(np.mean(d**2) / n)),
        "interval": both(mean, 1.96 * s / root),
        "of-the-first": both(p, a.std() / root),
        "sum": both(d.sum(), s / root),
        "sizes-of-the-differences": both(np.abs(d).mean(), np.abs(d).std() / root),
        "which-differ": both(np.mean(d != 0), s / root),
        "sorted": both(ordered.mean(), ordered.std() / root),
    }


@row.right  # By the variances and what they have in common.
def _(first, second):
    a = np.array(first, dtype=float)
    b = np.array(second, dtype=float)
    common = np.mean((a - a.mean()) * (b - b.mean()))
    spread = a.var() + b.var() - 2 * common
    return a.mean() - b.mean(), np.sqrt(max(spread, 0) / a.size)

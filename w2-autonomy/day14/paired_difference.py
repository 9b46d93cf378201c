"""14.9 `paired_difference(first, second)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((2,), names=("the mean", "the standard error")))


@row.inputs
def _(rng):
    yield np.array([True, True, False, True]), np.array([True, False, False, False])
    yield np.arange(100) < 80, np.arange(100) < 25
    yield np.arange(20) < 5, np.arange(20) >= 12
    for n, p, q in ((10, 0.8, 0.3), (40, 0.3, 0.7), (60, 0.9, 0.5), (25, 0.5, 0.5)):
        both = rng.uniform(size=n)
        yield both < p, np.where(rng.uniform(size=n) < 0.6, both, both[::-1]) < q
    for n in (5, 12, 30):
        yield rng.uniform(size=n) < 0.5, rng.uniform(size=n) < 0.5


@row.wrongs
def _(first, second):
    """unpaired: your code adds the variances of the two policies, as for independent
      samples. Use the standard deviation of the differences, because both policies ran
      on the same cubes
    n-minus-one: your code divides by `n - 1` in the standard deviation, or by `sqrt(n -
      1)` in the standard error. Divide by n and by `sqrt(n)` instead
    n-minus-one 2: your code divides by `n - 1` in the standard deviation, or by `sqrt(n
      - 1)` in the standard error. Divide by n and by `sqrt(n)` instead
    root-of-the-mean-square: your code takes the standard deviation about 0. Take the
      standard deviation about the mean difference instead
    interval: your code returns 1.96 standard errors as the second result. Return one
      standard error instead
    which-differ: your first result is the fraction of cubes on which the outcomes of
      the two policies differ. Return the mean difference instead
    sorted: your code sorts both lists, which destroys the pairing. Keep the order of
      the lists
    """
    a = np.asarray(first, float)
    b = np.asarray(second, float)
    n = len(a)
    d = a - b
    mean = d.mean()
    root = np.sqrt(n)
    s = d.std()
    ordered = np.sort(a) - np.sort(b)

    def both(m, sigma):
        return np.array([m, sigma])

    return {
        "unpaired": both(mean, np.sqrt((a.var() + b.var()) / n)),
        "n-minus-one": both(mean, d.std(ddof=1) / root),
        "n-minus-one 2": both(mean, s / np.sqrt(n - 1)),
        "root-of-the-mean-square": both(mean, np.sqrt(np.mean(d**2) / n)),
        "interval": both(mean, 1.96 * s / root),
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


@row.right  # By the counts of the cubes that only one of the two held.
def _(first, second):
    n = len(first)
    gained = sum(1 for a, b in zip(first, second, strict=True) if a and not b)
    lost = sum(1 for a, b in zip(first, second, strict=True) if b and not a)
    mean = (gained - lost) / n
    return mean, np.sqrt(max((gained + lost) / n - mean**2, 0.0) / n)

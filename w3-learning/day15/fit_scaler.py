"""15.3 `fit_scaler(x)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((2, None), rows=("the means", "the standard deviations")))


@row.inputs
def _(rng):
    yield (np.array([[1.0, 4], [3, 4]]),)
    yield (np.array([[2.0, -1, 5]]),)  # one row
    yield (np.array([[0.0, 0], [0, 1], [0, 5]]),)
    for n, d, middle in ((4, 2, 0.0), (6, 3, 2.0), (5, 1, -3.0), (9, 4, 1.0)):
        yield (middle + rng.numbers(0.2, 2.5, d) * rng.numbers(-1, 1, n, d),)
    x = rng.numbers(-1, 1, 5, 3)
    x[:, 1] = 2.0
    yield (x,)
    yield (np.array([[0.1, 1], [0.1, 2], [0.1, 6]]),)  # NumPy's std is not exactly 0


row.cases(
    a_constant_column=lambda x: bool((x == x[0]).all(axis=0).any()),
    columns_that_vary=lambda x: not (x == x[0]).all(axis=0).any(),
)


@row.wrongs(hidden={"rounded-to-0": "no column of the demonstrations is constant"})
def _(x):
    """n-minus-one: your code computes the standard deviation with the divisor n - 1.
      Divide by n instead, so that normalised columns have a standard deviation of
      exactly 1
    about-0: your second row contains the root mean square of each column. Subtract the
      mean of the column first, so that the result is the standard deviation
    one-for-all: your code uses one mean and one standard deviation for all columns. The
      columns can have different units and scales, so compute both for each column with
      `axis=0`
    spread-for-all: your code uses one standard deviation for all columns. The columns
      can have different units and scales, so compute one standard deviation per column
      with `axis=0`
    variance: your second row contains the variance of each column. Take the square root
      of each variance
    deviation: your second row contains the mean absolute deviation of each column. Take
      the square root of the mean squared deviation instead
    min-max: your code returns the minimum and the range of each column. Return the mean
      and the standard deviation instead
    constant-0: your code returns a standard deviation of 0 for a constant column, so
      `normalise` would divide by 0. Return 1 for such a column
    rounded-to-0: your code treats a column as constant only if its standard deviation
      is exactly 0. Rounding can give a constant column a standard deviation of about
      1e-17, so check whether all entries of the column are equal instead
    about-0 2: your second row contains the root mean square of each column. Subtract
      the mean of the column first, so that the result is the standard deviation
    one-for-all 2: your code uses one mean and one standard deviation for all columns.
      The columns can have different units and scales, so compute both for each column
      with `axis=0`
    spread-for-all 2: your code uses one standard deviation for all columns. The columns
      can have different units and scales, so compute one standard deviation per column
      with `axis=0`
    """
    mean = x.mean(axis=0)
    std = x.std(axis=0)
    constant = (x == x[0]).all(axis=0)
    one = np.where(constant, 1, std)

    def safe(s):
        return np.where(s < 1e-12, 1, s)

    def kept(s):  # with 1 for a constant column all the same
        return np.where(constant, 1, s)

    several = len(x) > 1
    return {
        "n-minus-one": lambda: np.array(
            [
                mean,
                safe(x.std(axis=0, ddof=1) if several else 0 * mean),
            ]
        ),
        "about-0": np.array([mean, safe(np.sqrt(np.mean(x**2, axis=0)))]),
        "one-for-all": np.array([0 * mean + x.mean(), 0 * mean + safe(x.std())]),
        "spread-for-all": np.array([mean, 0 * one + safe(x.std())]),
        "min-max": np.array([x.min(axis=0), safe(np.ptp(x, axis=0))]),
        "about-0 2": np.array([mean, kept(np.sqrt(np.mean(x**2, axis=0)))]),
        "one-for-all 2": np.array([0 * mean + x.mean(), kept(x.std())]),
        "spread-for-all 2": np.array([mean, kept(x.std())]),
        "variance": np.array([mean, safe(std**2)]),
        "deviation": np.array([mean, safe(np.mean(np.abs(x - mean), axis=0))]),
        "constant-0": np.array([mean, np.where(constant, 0, std)]),
        "rounded-to-0": np.array([mean, np.where(std == 0, 1, std)]),
    }


@row.right  # By hand, column by column.
def _(x):
    n = len(x)
    means, spreads = [], []
    for column in x.T:
        mean = sum(column) / n
        spread = np.sqrt(sum((one - mean) ** 2 for one in column) / n)
        means.append(mean)
        spreads.append(spread if np.ptp(column) > 0 else 1.0)
    return np.vstack((means, spreads))


@row.right  # The variance in one line.
def _(x):
    means = np.mean(x, 0)
    spread = np.sqrt(np.mean((x - means) ** 2, 0))
    spread[spread < 1e-12] = 1
    return np.stack([means, spread])


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield (size * rng.numbers(-1, 1, 5, 2),)

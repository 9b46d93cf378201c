"""15.3 `normalise(x, scaler)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None)))


def draw(rng):
    """Yield rows with a scaler of other rows."""
    yield np.array([[5.0, 4]]), np.array([[2.0, 4], [1, 1]])
    for n, d in ((1, 3), (3, 2), (4, 1), (5, 4), (2, 2)):
        scaler = np.array([rng.numbers(-2, 2, d), rng.numbers(0.2, 2.5, d)])
        yield rng.numbers(-2, 2, n, d), scaler


row.inputs(draw)


@row.wrong
def own_statistics(x, scaler):
    """your code computes the mean and the standard deviation from x. Use the argument
    `scaler` instead, so that all data are normalised in the same way"""
    spread = x.std(axis=0)
    return (x - x.mean(axis=0)) / np.where(spread == 0, 1, spread)


@row.wrong
def first_column(x, scaler):
    """your code uses the mean and the standard deviation of the first column for all
    columns. Use the whole rows `scaler[0]` and `scaler[1]` instead"""
    return (x - scaler[0, 0]) / scaler[1, 0]


@row.wrong(hidden="the lab's checks are on the rows of the training")
def own_mean(x, scaler):
    """your code subtracts the mean of x. Subtract the mean in the argument `scaler`
    instead, so that all data are normalised in the same way"""
    return (x - x.mean(axis=0)) / scaler[1]


@row.right  # Column by column.
def _(x, scaler):
    mean, std = scaler
    z = np.empty(x.shape)
    for j in range(x.shape[1]):
        z[:, j] = (x[:, j] - mean[j]) / std[j]
    return z


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield size * rng.numbers(-1, 1, 3, 2), np.array([[0.0, size], [size, size]])

"""15.3 `denormalise(z, scaler)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .normalise import draw

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    (_, first), *others = draw(rng)
    yield np.array([[3.0, 0]]), first
    yield from others


@row.wrong
def mean_first(z, scaler):
    """your code adds the mean before multiplying by the standard deviation. Undo the
    steps of `normalise` in reverse order: first multiply, then add"""
    return (z + scaler[0]) * scaler[1]


@row.wrong
def normalised_again(z, scaler):
    """your code subtracts the mean and divides by the standard deviation, as
    `normalise` does. Undo these steps: first multiply by the standard deviation, then
    add the mean"""
    return (z - scaler[0]) / scaler[1]


@row.wrong
def own_statistics(z, scaler):
    """your code computes the mean and the standard deviation from z. Use the argument
    `scaler` instead, because the data were normalised with it"""
    spread = z.std(axis=0)
    return z * np.where(spread == 0, 1, spread) + z.mean(axis=0)


@row.right  # Column by column.
def _(z, scaler):
    x = np.empty(z.shape)
    for j, (mean, std) in enumerate(scaler.T):
        x[:, j] = mean + std * z[:, j]
    return x


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield rng.numbers(-1, 1, 3, 2), size * np.array([[0.0, 1], [1, 1]])

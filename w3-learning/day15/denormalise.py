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
    """in your code, the mean is added before the multiplication, so it is scaled as
    well. Undo the steps of `normalise` in the opposite order: multiply, then add"""
    return (z + scaler[0]) * scaler[1]


@row.wrong
def normalised_again(z, scaler):
    """in your code, the mean is subtracted and the difference divided, as in
    `normalise`. Undo these steps: multiply by the standard deviation, then add the
    mean"""
    return (z - scaler[0]) / scaler[1]


@row.wrong
def own_statistics(z, scaler):
    """in your code, the mean and the standard deviation are computed from z itself.
    Use those in the scaler, with which `normalise` was called"""
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

"""15.5 `mse(pred, target)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Scalar

row = Row((
    Scalar(called="the loss"),
    Matrix((None, None), called="the gradient"),
))  # fmt: skip


@row.inputs
def _(rng):
    yield np.array([[1.0, 2]]), np.zeros((1, 2))
    for n, m in ((3, 1), (2, 2), (4, 3), (1, 1), (5, 2)):
        yield rng.numbers(-2, 2, n, m), rng.numbers(-2, 2, n, m)


row.cases(
    one_column=lambda pred, target: pred.shape[1] == 1,
    several_columns=lambda pred, target: pred.shape[1] > 1,
)


@row.wrongs
def _(pred, target):
    """summed-over-columns: your code divides the loss and its gradient by the number of
      rows only. Divide both by n * m, because the loss is the mean over all entries
    summed-over-columns 2: your code divides the loss by the number of rows only. Divide
      the loss by n * m, because it is the mean over all entries. Your gradient is
      correct
    absolute: your loss is the mean absolute error. Return the mean squared error
      instead
    not-divided: your gradient is `2 * (pred - target)`. Divide this gradient by n * m,
      because the loss is the mean over n * m entries
    divided-by-rows: your code divides the gradient by the number of rows only. Divide
      the gradient by n * m, because the loss is the mean over n rows and m columns
    half: your loss and its gradient contain an extra factor of 1/2. Omit this factor,
      because the loss in this task is the mean of the squared errors
    """
    e = pred - target
    n = len(e)
    return {
        "summed-over-columns": (np.sum(e**2) / n, 2 * e / n),
        "summed-over-columns 2": (np.sum(e**2) / n, 2 * e / e.size),
        "absolute": (np.mean(np.abs(e)), 2 * e / e.size),
        "not-divided": (np.mean(e**2), 2 * e),
        "divided-by-rows": (np.mean(e**2), 2 * e / n),
        "half": (np.mean(e**2) / 2, e / e.size),
    }


@row.right  # By the norm.
def _(pred, target):
    e = (pred - target) / np.sqrt(pred.size)
    return np.linalg.norm(e) ** 2, 2 * e / np.sqrt(pred.size)


@row.right  # Entry by entry.
def _(pred, target):
    n, m = pred.shape
    loss = 0.0
    slope = np.zeros((n, m))
    for i in range(n):
        for j in range(m):
            e = pred[i, j] - target[i, j]
            loss += e * e / (n * m)
            slope[i, j] = 2 * e / (n * m)
    return loss, slope


@row.spans
def _(rng):
    for size in (1e-4, 1e3):
        yield size * rng.numbers(-1, 1, 3, 2), size * rng.numbers(-1, 1, 3, 2)

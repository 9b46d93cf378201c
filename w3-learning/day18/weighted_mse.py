"""18.3 `weighted_mse(pred, target, weight)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Scalar

row = Row((
    Scalar(called="the loss"),
    Matrix((None, None), called="the gradient"),
))  # fmt: skip


@row.inputs
def _(rng):
    yield np.array([[1.0], [2]]), np.zeros((2, 1)), np.array([1.0, 3])
    yield np.array([[1.0, 2]]), np.zeros((1, 2)), np.array([0.5])
    yield np.array([[1.0, 2], [4, 0]]), np.ones((2, 2)), np.array([2.0, 0])
    for n, m in ((3, 1), (2, 2), (4, 3), (5, 2)):
        weight = rng.numbers(0.1, 3, n)
        yield rng.numbers(-2, 2, n, m), rng.numbers(-2, 2, n, m), weight
    yield rng.numbers(-2, 2, 3, 2), rng.numbers(-2, 2, 3, 2), np.ones(3)


row.cases(
    equal_weights=lambda pred, target, weight: len(set(weight.tolist())) == 1,
    different_weights=lambda pred, target, weight: len(set(weight.tolist())) > 1,
)
row.cases(
    one_column=lambda pred, target, weight: pred.shape[1] == 1,
    several_columns=lambda pred, target, weight: pred.shape[1] > 1,
)


@row.wrongs
def _(pred, target, weight):
    """mean: your code divides the weighted sum of the squared errors by the number of
      rows. Divide this sum by the sum of the weights instead, so that doubling all
      weights does not change the loss
    summed: your code does not divide by the sum of the weights. The loss is a weighted
      mean, so divide both the loss and the gradient by this sum
    summed-over-columns: your code sums the squared errors over the columns. Take the
      mean over the columns instead, as `mse` does
    weight-squared: your loss and its gradient contain the squares of the weights.
      Square only the errors, and multiply each squared error by its weight
    unweighted: your code ignores the weights. Multiply the mean squared error of each
      row by its weight, and divide the sum over the rows by the sum of the weights
    gradient-unweighted: your gradient ignores the weights. Multiply each row of the
      gradient by its weight, and divide by the sum of the weights instead of the number
      of rows
    gradient-not-divided: your gradient is 2 * w * e, where w is the weight and e is the
      error. Divide this product by the sum of the weights and by the number of columns,
      as in the loss
    gradient-mean: your code divides the gradient by the number of rows. Divide the
      gradient by the sum of the weights instead, as in the loss
    absolute: your code uses the absolute value of each error. Use the square of each
      error instead
    row-means: your code squares the mean error of each row. Take the mean of the
      squared errors instead, because errors of opposite sign cancel in the mean error
    largest-weight: your code divides the weighted sum of the squared errors by the
      largest weight times the number of rows. Divide this sum by the sum of the weights
      instead
    weighted-rows: your code divides the weighted sum of the squared errors by the
      number of rows whose weight is not 0. Divide this sum by the sum of the weights
      instead
    """
    e = pred - target
    n, m = e.shape
    w = weight[:, None]
    total, top = weight.sum(), n * weight.max()
    used = np.count_nonzero(weight)
    middle = e.mean(axis=1, keepdims=True)
    loss, slope = np.sum(w * e**2) / (m * total), 2 * w * e / (m * total)
    return {
        "mean": (np.mean(w * e**2), 2 * w * e / (n * m)),
        "summed": (np.sum(w * e**2) / m, 2 * w * e / m),
        "summed-over-columns": (m * loss, m * slope),
        "weight-squared": (np.sum((w * e) ** 2) / (m * total),
                           2 * w**2 * e / (m * total)),
        "unweighted": (np.mean(e**2), 2 * e / (n * m)),
        "gradient-unweighted": (loss, 2 * e / (n * m)),
        "gradient-not-divided": (loss, 2 * w * e),
        "gradient-mean": (loss, 2 * w * e / (n * m)),
        "absolute": (np.sum(w * np.abs(e)) / (m * total),
                     w * np.sign(e) / (m * total)),
        "row-means": (np.sum(w * middle**2) / total,
                      2 * w * middle * np.ones(m) / (m * total)),
        "largest-weight": (loss * total / top, slope * total / top),
        "weighted-rows": (loss * total / used, slope * total / used),
    }  # fmt: skip


@row.right  # By np.average.
def _(pred, target, weight):
    each = np.mean((pred - target) ** 2, axis=1)  # each row's mean squared error
    part = weight / weight.sum()
    slope = 2 * part[:, None] * (pred - target) / pred.shape[1]
    return np.average(each, weights=weight), slope


@row.right  # Row by row.
def _(pred, target, weight):
    loss, slope, total = 0.0, np.zeros(pred.shape), sum(weight)
    for i in range(len(pred)):
        e = pred[i] - target[i]
        loss += weight[i] * (e @ e) / len(e)
        slope[i] = 2 * weight[i] * e / len(e) / total
    return loss / total, slope


@row.spans
def _(rng):
    for size in (1e-3, 10.0):
        pair = size * rng.numbers(-1, 1, 2, 3, 2)
        yield *pair, np.array([0.125, 15.0, 0.7])


row.at_least_0(weight="the docstring says so")

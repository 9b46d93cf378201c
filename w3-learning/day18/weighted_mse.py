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
    """mean: your code divides by the number of rows. Divide by the sum of the
      weights, so that doubled weights give the same loss
    summed: your code does not divide by the sum of the weights. The loss is a
      weighted mean, so doubled weights should give the same loss
    summed-over-columns: your code sums the squares over the columns. Take the mean
      over the columns, as `mse` does
    weight-squared: your code multiplies the error by the weight before the square.
      Multiply the squared error by the weight
    unweighted: your code ignores the weights
    gradient-unweighted: your gradient ignores the weights. The derivative of w e^2
      is 2 w e
    gradient-not-divided: your gradient is 2 w e. The loss is divided by the sum of
      the weights and by the number of columns, so divide the gradient by both
    gradient-mean: your code divides the gradient by the number of rows. The loss is
      divided by the sum of the weights, so divide the gradient by this sum
    absolute: your code uses the absolute value of each error. Square the errors
    row-means: your code squares the mean error of each row. Take the mean of the
      squared errors, because errors of opposite sign cancel in their mean
    largest-weight: your code divides by the largest weight and by the number of rows.
      Divide by the sum of the weights
    weighted-rows: your code divides by the number of rows whose weight is not 0.
      Divide by the sum of the weights, so that doubled weights give the same loss
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

"""16.2 `masked_l1(pred, target, mask)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from labkit.judge.kinds import Kind

row = Row(
    (Scalar(called="the loss"), Kind((None, None, None), called="the gradient")),
    # The derivative jumps at 0: there the inputs ask once, on purpose.
    at_edge=lambda pred, target, mask: bool(
        np.all(np.abs(pred - target) > 1e-3) and np.sum(mask) > 0
    ),
)


def errors(rng, n, K, m):
    """Return predictions and targets, none of whose errors is small."""
    target = rng.numbers(-1, 1, n, K, m)
    size = rng.numbers(0.05, 2, n, K, m)
    return target + size * rng.choice([-1.0, 1.0], (n, K, m)), target


def ending(n, K, *existing):
    """Return a mask whose rows have so many entries that exist."""
    return 1.0 * (np.arange(K) < np.resize(existing, n)[:, None])


@row.inputs
def _(rng):
    pred = np.array([[[1.0], [9]], [[3], [0]]])
    yield pred, 0 * pred, np.array([[1.0, 0], [1, 1]])
    yield *errors(rng, 2, 3, 2), np.ones((2, 3))  # without padding
    yield *errors(rng, 1, 2, 3), ending(1, 2, 1)
    for n, K, m in ((3, 4, 2), (4, 2, 1), (2, 3, 3), (3, 1, 2)):
        yield *errors(rng, n, K, m), ending(n, K, 1, K)
    pred, target = errors(rng, 3, 3, 2)
    pred[1, 0] = target[1, 0]  # an error of exactly 0
    yield pred, target, ending(3, 3, 3, 2, 1)


row.cases(
    masks_without_padding=lambda pred, target, mask: bool((mask != 0).all()),
    masks_with_padding=lambda pred, target, mask: bool((mask == 0).any()),
)
row.cases(
    one_column=lambda pred, target, mask: pred.shape[2] == 1,
    several_columns=lambda pred, target, mask: pred.shape[2] > 1,
)


@row.wrongs
def _(pred, target, mask):
    """divided-by-all: your code divides the sum of the absolute errors by n * K * m,
      which also counts the padded entries. Divide this sum by m times the sum of the
      mask instead
    mask-forgotten: your code averages over all entries, including the padding. Multiply
      the absolute errors by the mask, and divide their sum by m times the sum of the
      mask
    loss-unmasked: your gradient is correct, but your loss is the mean over all entries,
      including the padding. Multiply the absolute errors by the mask, and divide their
      sum by m times the sum of the mask
    gradient-unmasked: your loss is correct, but your gradient is not 0 for padded
      entries. Multiply the gradient by the mask, because padded entries have no effect
      on the loss
    squared: your function computes the mean squared error and its gradient. Use the
      absolute values of the errors instead of their squares
    mean-of-means: your code computes the mean absolute error of each chunk and then
      averages these means. Take one mean over all existing entries instead, so that
      each entry has the same weight
    gradient-not-divided: your gradient is the sign of each existing error. Divide these
      signs by m times the sum of the mask, as in the loss
    divided-by-rows: your code divides the sum of the absolute errors by the number of
      rows. Divide this sum by the number of existing errors instead, which is m times
      the sum of the mask
    gradient-by-all: your loss is correct, but your code divides the gradient by the
      total number of entries, including the padding. Divide the gradient by m times the
      sum of the mask, as in the loss
    not-0-at-0: your gradient is not 0 where the error is 0. Use 0 as the derivative of
      |e| at 0, as `np.sign` does
    not-0-at-0 2: your gradient is not 0 where the error is 0. Use 0 as the derivative
      of |e| at 0, as `np.sign` does
    norms: your loss contains the Euclidean norm of the m errors of each entry. Use the
      sum of the absolute values of these errors instead
    norms 2: your loss contains the Euclidean norm of the m errors of each entry. Use
      the sum of the absolute values of these errors instead
    root-mean-square: your loss is the square root of the mean squared error. Use the
      mean of the absolute values of the errors instead
    """
    w = mask[..., None] * 1.0
    m = pred.shape[2]
    e = pred - target
    total = m * mask.sum()
    size, sign = np.abs(e), np.sign(e)
    loss, grad = np.sum(w * size) / total, w * sign / total
    each = w / (m * mask.sum(axis=1)[:, None, None] * len(e))
    norm = np.linalg.norm(e, axis=2, keepdims=True)
    ahead = np.divide(e, norm, out=np.zeros_like(e), where=norm > 0)
    norms = np.sum(w * norm), w * ahead
    rms = np.sqrt(np.sum(w * e**2) / total)
    return {
        "divided-by-all": (np.sum(w * size) / e.size, w * sign / e.size),
        "mask-forgotten": (size.mean(), sign / e.size),
        "loss-unmasked": (size.mean(), grad),
        "gradient-unmasked": (loss, sign / total),
        "squared": (np.sum(w * e**2) / total, 2 * w * e / total),
        "mean-of-means": (np.sum(each * size), each * sign),
        "gradient-not-divided": (loss, w * sign),
        "divided-by-rows": (np.sum(w * size) / len(e), w * sign / len(e)),
        "gradient-by-all": (loss, w * sign / e.size),
        "not-0-at-0": (loss, w * np.where(e >= 0, 1, -1) / total),
        "not-0-at-0 2": (loss, w * np.where(e > 0, 1, -1) / total),
        "norms": (norms[0] / total, norms[1] / total),
        "root-mean-square": (rms, w * e / (total * rms)),
        "norms 2": (m * norms[0] / total, m * norms[1] / total),
    }


@row.right  # The entries that exist are selected.
def _(pred, target, mask):
    there = mask.astype(bool)
    e = (pred - target)[there]
    grad = np.zeros(pred.shape)
    grad[there] = np.sign(e) / e.size
    return np.abs(e).mean(), grad


@row.right  # Entry by entry.
def _(pred, target, mask):
    n, K, m = pred.shape
    count = 0
    total = 0.0
    grad = np.zeros((n, K, m))
    for i in range(n):
        for j in range(K):
            if mask[i, j]:
                count += m
                for c in range(m):
                    e = pred[i, j, c] - target[i, j, c]
                    total += abs(e)
                    grad[i, j, c] = 0 if e == 0 else (1 if e > 0 else -1)
    return total / count, grad / count


@row.right  # The mean of each entry's columns, then a weighted mean.
def _(pred, target, mask):
    e = pred - target
    loss = np.average(np.mean(np.abs(e), axis=2), weights=mask)
    slope = (e > 0).astype(float) - (e < 0)
    return loss, np.einsum("ij,ijk->ijk", mask / mask.sum(), slope) / e.shape[2]


@row.spans
def _(rng):
    pred, target = errors(rng, 16, 12, 2)
    for size in (1e-4, 1e3):
        yield size * pred, size * target, ending(16, 12, 1, 12)
    yield pred[:3, :2], target[:3, :2], ending(3, 2, 1, 2) == 1  # truth values

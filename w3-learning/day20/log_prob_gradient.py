"""20.1 `log_prob_gradient(action, mean, log_std)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .actions import gaussians

row = Row((
    Matrix((None, None), called="the gradient with respect to the mean"),
    Matrix((None, None), called="the gradient with respect to log_std"),
), near=1e-3)  # fmt: skip


@row.inputs
def _(rng):
    yield from gaussians(rng)


row.cases(
    a_std_of_1=lambda action, mean, log_std: not log_std.any(),
    another_std=lambda action, mean, log_std: bool(log_std.any()),
)


@row.wrongs
def _(action, mean, log_std):
    """not-divided-again: your gradient with respect to the mean is z = (action - mean)
      / std. Divide z by std, because the derivative of z with respect to the mean is -1
      / std
    by-the-action: your gradient with respect to the mean has the wrong sign. If the
      action is above the mean, raising the mean makes this action more likely, so the
      derivative is positive
    by-std: your second gradient is the gradient with respect to the standard deviation.
      Multiply this gradient by the standard deviation to obtain the gradient with
      respect to `log_std`
    determinant-forgotten: your gradient with respect to `log_std` is z^2. Subtract 1,
      because the log-probability contains the term `-log_std`, whose derivative is -1
    of-the-density: your function returns the gradient of the density. Divide this
      gradient by the density to obtain the gradient of the logarithm
    of-the-density 2: your code multiplies both gradients by the density of the action.
      Omit this factor, because the result is the gradient of the log-probability and
      not of the density
    averaged: your code divides both gradients by the number of actions. Omit this
      division, because each row should be the gradient for a single action
    half: your gradient with respect to `log_std` contains z^2 / 2. Use z^2 instead,
      because the derivative of `-z^2 / 2` with respect to `log_std` is z^2
    """
    std = np.exp(log_std)
    z = (action - mean) / std
    right = z / std, z**2 - 1
    density = np.exp(-(z**2) / 2) / (std * np.sqrt(2 * np.pi))
    whole = density.prod(axis=1, keepdims=True)
    return {
        "not-divided-again": (z, right[1]),
        "by-the-action": (-right[0], right[1]),
        "by-std": (right[0], right[1] / std),
        "determinant-forgotten": (right[0], z**2),
        "of-the-density": (density * right[0], density * right[1]),
        "of-the-density 2": (whole * right[0], whole * right[1]),
        "averaged": (right[0] / len(action), right[1] / len(action)),
        "half": (right[0], z**2 / 2 - 1),
    }


@row.right  # With the variance.
def _(action, mean, log_std):
    var = np.exp(2 * log_std)
    e = action - mean
    return e / var, (e**2 - var) / var


@row.right  # By the complex step.
def _(action, mean, log_std):
    def each(mean, log_std):
        return -(((action - mean) / np.exp(log_std)) ** 2) / 2 - log_std

    h = 1e-30
    return each(mean + 1j * h, log_std).imag / h, each(mean, log_std + 1j * h).imag / h


@row.spans
def _(rng):
    wide = np.array([-0.9, 2.0])
    for size in (1e-3, 3.0):
        yield size * rng.numbers(-1, 1, 3, 2), size * rng.numbers(-1, 1, 3, 2), wide

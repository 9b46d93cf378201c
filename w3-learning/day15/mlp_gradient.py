"""15.6 `mlp_gradient(x, target, W1, ..., b3)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Slip

from .nets import GRADIENTS, ONE, net, problems

row = Row(
    GRADIENTS,
    slips=(
        Slip(
            "^ValueError.*matmul",
            r"\b[dDgGe]\w* ?@ ?W[23]\b(?!\.(T|mT|transpose))",
            "not-transposed",
            "Your function stops because a weight matrix is not transposed. In the "
            "backward pass, multiply a gradient of shape (n, outputs) by W^T, whose "
            "shape is (outputs, inputs).",
        ),
    ),
)


@row.inputs
def _(rng):
    yield np.ones((1, 1)), np.zeros((1, 1)), *ONE
    yield from problems(rng)


row.cases(
    one_row=lambda x, *_: len(x) == 1,
    several_rows=lambda x, *_: len(x) > 1,
)
row.cases(
    a_square_second_layer=lambda x, t, W1, b1, W2, *_: W2.shape[0] == W2.shape[1],
    layers_of_different_sizes=lambda x, t, W1, b1, W2, *_: W2.shape[0] != W2.shape[1],
)


def backwards(
    x, target, arrays, slope=lambda h: 1 - h**2, first=lambda e: 2 * e / e.size
):
    """Return the six gradients, with another derivative of tanh, or of the loss.

    Args:
        x, target: rows.
        arrays: the network.
        slope: of tanh, from its output h.
        first: from the error (n, m) to the gradient with respect to the output.
    """
    W1, b1, W2, b2, W3, b3 = arrays
    h1 = np.tanh(x @ W1 + b1)
    h2 = np.tanh(h1 @ W2 + b2)
    d3 = first(h2 @ W3 + b3 - target)
    d2 = (d3 @ W3.T) * slope(h2)
    d1 = (d2 @ W2.T) * slope(h1)
    return (
        x.T @ d1, d1.sum(axis=0),
        h1.T @ d2, d2.sum(axis=0),
        h2.T @ d3, d3.sum(axis=0),
    )  # fmt: skip


@row.wrongs
def _(x, target, W1, b1, W2, b2, W3, b3):
    """slope-forgotten: your code omits the derivative of tanh. Multiply the gradient
      with respect to the output h of each hidden layer by 1 - h^2
    slope-squared: your code squares the derivative of tanh. Multiply the gradient with
      respect to the output h of each hidden layer by 1 - h^2 only once
    slope-1-minus-h: your derivative of tanh is 1 - h, where h is the output of a hidden
      layer. Use 1 - h^2 instead
    slope-logistic: your code uses h * (1 - h), which is the derivative of a logistic
      function with the output h. Use 1 - h^2 instead, because the hidden layers apply
      tanh
    slope-of-h: your derivative of tanh is 1 - tanh(h)^2, where h is the output of a
      hidden layer. Use 1 - h^2 instead, because h is already the output of tanh
    slope-of-z: your derivative of tanh is 1 - z^2, where z is the argument of tanh. Use
      1 - h^2 instead, where h = tanh(z) is the output of the hidden layer
    slope-not-passed-on: your code omits the derivative of the second tanh from the
      gradients with respect to W1 and b1. Multiply the gradient with respect to the
      output h of the second hidden layer by 1 - h^2, and only then by W2^T
    tanh-at-the-end: your code applies tanh to the output. The last layer of `mlp` is
      linear, so omit this tanh
    tanh-at-the-end 2: your code applies tanh to the output and multiplies the gradient
      by the derivative of this tanh. The last layer of `mlp` is linear, so omit this
      tanh and its derivative
    divided-twice: all your gradients contain an extra factor 1 / n, where n is the
      number of rows. Divide by n * m only once, and sum over the rows without another
      division
    weights-mean: your gradients with respect to the weights contain an extra factor 1 /
      n, where n is the number of rows. Divide by n * m only once, and sum over the rows
      without another division
    slope-at-the-end: your gradient with respect to the output contains the derivative
      of tanh as a factor. The last layer is linear, so omit this factor
    transposed: your gradients with respect to the weights are transposed. Each gradient
      should have the shape of its weight matrix
    bias-mean: your gradients with respect to the biases contain an extra factor 1 / n,
      where n is the number of rows. Divide by n * m only once, and sum over the rows
      without another division
    summed-loss: your function returns the gradients of the sum of the squared errors.
      Divide these gradients by n * m, because the loss is the mean of the squared
      errors
    rows-only: your code divides the gradients by the number of rows only. Divide the
      gradients by n * m, because the loss is the mean over n rows and m columns
    """
    given = x, target, (W1, b1, W2, b2, W3, b3)
    slopes = {
        "slope-forgotten": lambda h: 1 + 0 * h,
        "slope-squared": lambda h: (1 - h**2) ** 2,
        "slope-1-minus-h": lambda h: 1 - h,
        "slope-logistic": lambda h: h * (1 - h),
        "slope-of-h": lambda h: 1 - np.tanh(h) ** 2,
    }
    right = backwards(*given)
    turned = tuple(one.T for one in right)

    def at_the_end(e):
        return 2 * e / e.size * (1 - (e + target) ** 2)

    def tanh_too(e):
        return 2 * (np.tanh(e + target) - target) / e.size

    def tanh_and_slope(e):
        return tanh_too(e) * (1 - np.tanh(e + target) ** 2)

    first = np.tanh(x @ W1 + b1)
    d3 = 2 * (np.tanh(first @ W2 + b2) @ W3 + b3 - target) / target.size
    d1 = (d3 @ W3.T) @ W2.T * (1 - first**2)

    return {
        **{slug: backwards(*given, slope) for slug, slope in slopes.items()},
        "slope-of-z": backwards(*given, lambda h: 1 - np.arctanh(h) ** 2),
        "slope-not-passed-on": (x.T @ d1, d1.sum(axis=0), *right[2:]),
        "tanh-at-the-end": backwards(*given, first=tanh_too),
        "tanh-at-the-end 2": backwards(*given, first=tanh_and_slope),
        "divided-twice": tuple(one / len(x) for one in right),
        "weights-mean": tuple(one / len(x) if one.ndim > 1 else one for one in right),
        "slope-at-the-end": backwards(*given, first=at_the_end),
        "transposed": turned,
        "bias-mean": tuple(one / len(x) if one.ndim == 1 else one for one in right),
        "summed-loss": backwards(*given, first=lambda e: 2 * e),
        "rows-only": backwards(*given, first=lambda e: 2 * e / len(x)),
    }


@row.right  # By the complex step, entry by entry.
def _(x, target, *arrays):
    grads = []
    for i, array in enumerate(arrays):
        grad = np.zeros(array.shape)
        for at in np.ndindex(array.shape):
            some = [one.astype(complex) for one in arrays]
            some[i][at] += 1e-30j
            h = x
            for W, b in ((some[0], some[1]), (some[2], some[3])):
                h = np.tanh(h @ W + b)
            loss = np.mean((h @ some[4] + some[5] - target) ** 2)
            grad[at] = loss.imag / 1e-30
        grads.append(grad)
    return tuple(grads)


@row.right  # Row by row, with outer products, and the slope as 1 / cosh^2.
def _(x, target, W1, b1, W2, b2, W3, b3):
    grads = [np.zeros(one.shape) for one in (W1, b1, W2, b2, W3, b3)]
    for one, wanted in zip(x, target):
        z1 = one @ W1 + b1
        z2 = np.tanh(z1) @ W2 + b2
        d3 = 2 * (np.tanh(z2) @ W3 + b3 - wanted) / target.size
        d2 = W3 @ d3 / np.cosh(z2) ** 2
        d1 = W2 @ d2 / np.cosh(z1) ** 2
        for k, (h, d) in enumerate(((one, d1), (np.tanh(z1), d2), (np.tanh(z2), d3))):
            grads[2 * k] += np.outer(h, d)
            grads[2 * k + 1] += d
    return tuple(grads)


@row.right  # With a list of layers, from the last to the first.
def _(x, target, W1, b1, W2, b2, W3, b3):
    weights, outputs = [W1, W2, W3], [x]
    for W, b in ((W1, b1), (W2, b2)):
        outputs.append(np.tanh(outputs[-1] @ W + b))
    d = 2 * (outputs[-1] @ W3 + b3 - target) / target.size
    grads = []
    for W, h in zip(weights[::-1], outputs[::-1]):
        grads = [h.T @ d, np.ones(len(x)) @ d, *grads]
        d = (d @ W.T) * (1 - h * h)
    return tuple(grads)


@row.spans
def _(rng):
    x = rng.numbers(-1, 1, 3, 2)
    for size in (1e-3, 4.0):
        arrays = (size * one for one in net(rng, 2, 3, 2, 2))
        yield 4.0 * x, rng.numbers(-4, 4, 3, 2), *arrays

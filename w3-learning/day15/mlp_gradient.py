"""15.6 `mlp_gradient(x, target, W1, ..., b3)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Slip

from .nets import GRADIENTS, ONE, net, problems

row = Row(
    GRADIENTS,
    slips=(
        Slip(
            "^ValueError.*matmul",
            r"@ ?W[23] ?\)",
            "not-transposed",
            "Your function stops because a weight matrix is not transposed. On the way "
            "back, a gradient (n, outputs) is multiplied by W^T, (outputs, inputs).",
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


def backwards(x, target, arrays, slope=lambda h, z: 1 - h**2, through=None, d3=None):
    """Return the six gradients, where a step of the way back may be another.

    Args:
        x, target: rows.
        arrays: the network.
        slope: of tanh, from its output h and its input z.
        through: from a gradient and its weights to that of the layer's input.
        d3: from the error (n, m) to the gradient with respect to the output.
    """
    W1, b1, W2, b2, W3, b3 = arrays
    through = through or (lambda d, W: d @ W.T)
    z1 = x @ W1 + b1
    h1 = np.tanh(z1)
    z2 = h1 @ W2 + b2
    h2 = np.tanh(z2)
    e = h2 @ W3 + b3 - target
    d3 = d3(e) if d3 else 2 * e / e.size
    d2 = through(d3, W3) * slope(h2, z2)
    d1 = through(d2, W2) * slope(h1, z1)
    return (
        x.T @ d1, d1.sum(axis=0),
        h1.T @ d2, d2.sum(axis=0),
        h2.T @ d3, d3.sum(axis=0),
    )  # fmt: skip


@row.wrongs
def _(x, target, W1, b1, W2, b2, W3, b3):
    """slope-forgotten: the derivative of tanh is missing. Each layer's gradient is
      multiplied by 1 - h^2, where h is the layer's output
    slope-squared: the derivative of tanh is squared. Multiply by 1 - h^2 once per layer
    slope-of-h: the derivative of tanh is computed as 1 - tanh(h)^2 from the layer's
      output h. The output is tanh already, so the derivative is 1 - h^2
    bias-mean: the gradients of the biases are means over the rows. The loss has the
      factor 1 / (n m) already, so sum over the rows
    summed-loss: the gradient is that of the sum of the squares. The loss is their mean,
      so divide by n m
    rows-only: the gradient is divided by the number of rows. The loss is a mean over
      rows and columns, so divide by n m
    first-slope-forgotten: the derivative of the first tanh is missing in the gradients
      of W1 and b1
    biases-forgotten: the network is computed without its biases
    """
    arrays = (W1, b1, W2, b2, W3, b3)
    right = backwards(x, target, arrays)

    def plain(h, z):
        return 1.0 + 0.0 * h

    z2 = np.tanh(x @ W1 + b1) @ W2 + b2
    h2 = np.tanh(z2)
    e = h2 @ W3 + b3 - target
    no_slope = ((2 * e / e.size) @ W3.T * (1 - h2**2)) @ W2.T
    return {
        "slope-forgotten": backwards(x, target, arrays, plain),
        "slope-squared": backwards(x, target, arrays, lambda h, z: (1 - h**2) ** 2),
        "slope-of-h": backwards(x, target, arrays, lambda h, z: 1 - np.tanh(h) ** 2),
        "bias-mean": tuple(one / len(x) if one.ndim == 1 else one for one in right),
        "summed-loss": backwards(x, target, arrays, d3=lambda e: 2 * e),
        "rows-only": backwards(x, target, arrays, d3=lambda e: 2 * e / len(x)),
        "first-slope-forgotten": (x.T @ no_slope, no_slope.sum(axis=0), *right[2:]),
        "biases-forgotten": backwards(x, target, (W1, 0 * b1, W2, 0 * b2, W3, 0 * b3)),
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

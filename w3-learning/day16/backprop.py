"""16.3 `backprop(x, d, W1, ..., b3)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Slip

from .nets import GRADIENTS, net, one, problems

row = Row(
    GRADIENTS,
    slips=(
        Slip(
            "^ValueError.*matmul",
            r"\b[dDgGe]\w* ?@ ?W[123]\b(?!\.(T|mT|transpose))",
            "not-transposed",
            "Your function stops because a weight matrix is not transposed. In the "
            "backward pass, multiply a gradient of shape (n, outputs) by W^T, whose "
            "shape is (outputs, inputs).",
        ),
    ),
)


@row.inputs
def _(rng):
    yield np.zeros((1, 1)), np.ones((1, 1)), *one(1, 1, 1)
    yield np.zeros((1, 1)), np.ones((1, 1)), *one(2, 3, 1)
    yield from problems(rng)


row.cases(
    one_row=lambda x, *_: len(x) == 1,
    several_rows=lambda x, *_: len(x) > 1,
)
row.cases(
    a_square_first_layer=lambda x, d, W1, *_: W1.shape[0] == W1.shape[1],
    layers_of_different_sizes=lambda x, d, W1, *_: W1.shape[0] != W1.shape[1],
)


@row.wrongs
def _(x, d, W1, b1, W2, b2, W3, b3):
    """slope-forgotten: your code omits the derivative of tanh. Multiply the gradient
      with respect to the output h of each hidden layer by `1 - h^2`
    slope-forgotten 2: your code omits the derivative of the first tanh. Multiply the
      gradient with respect to the output h of the first hidden layer by `1 - h^2`
    slope-forgotten 3: your code omits the derivative of the second tanh. Multiply the
      gradient with respect to the output h of the second hidden layer by `1 - h^2`
    dx-before-the-slope: your code omits the derivative of the first tanh from the
      gradient with respect to x. Multiply by `1 - h^2` before you multiply by W1^T,
      where h is the output of the first layer
    dx-with-input-slope: your code multiplies the gradient with respect to x by `1 -
      x^2`. Omit this factor, because x is the input and not the output of a tanh
    slope-of-h: your derivative of tanh is `1 - tanh(h)^2`, where h is the output of the
      hidden layer. Use `1 - h^2` instead, because h is already the output of tanh
    mse-again: your code multiplies d by 2 and divides it by the number of entries. Use
      d itself, because d is already the gradient of the loss with respect to the
      outputs
    dx-mean: your code divides the gradient with respect to x by the number of rows.
      Omit this division, because d is already the gradient of the whole loss
    slope-at-the-end: your code multiplies d by the derivative of tanh. Omit this
      factor, because the last layer is linear
    dx-of-the-hidden: your seventh result is the gradient with respect to the output of
      the first layer, not with respect to x. Multiply this gradient by the derivative
      of the first tanh, and then by W1^T
    slope-at-the-end 2: your code multiplies d by the derivative of tanh. Omit this
      factor, because the last layer is linear
    slope-of-the-sum: your derivative of tanh is `1 - z^2`, where z is the argument of
      tanh. Use `1 - h^2` instead, where h = tanh(z) is the output of the hidden layer
    no-biases: your code omits the biases in the forward pass. Add the bias of each
      hidden layer before tanh, because the bias changes the output of the layer
    slope-of-relu: your code uses the derivative of a ReLU, which is 1 for positive
      outputs and 0 for all others. Use the derivative of tanh instead, which is `1 -
      h^2`, where h is the output of the layer
    slope-of-relu 2: your code uses the derivative of a ReLU for the second layer. Use
      the derivative of tanh instead, which is `1 - h^2`, where h is the output of the
      layer
    mean-again: your code divides the gradients with respect to the weights and biases
      by the number of rows. Omit this division, because d is already the gradient of
      the whole loss
    dx-accumulated: your code accumulates the gradient with respect to x over the rows.
      Return a separate gradient for each row, because a row of x affects only its own
      outputs
    """
    h1 = np.tanh(x @ W1 + b1)
    h2 = np.tanh(h1 @ W2 + b2)

    def of_tanh(h):
        return 1 - h**2

    def no_slope(h):
        return 1 + 0 * h

    def back(d, slope=of_tanh, second=None, h1=h1, h2=h2, of=None):
        d2 = (d @ W3.T) * (second or slope)(of[1] if of else h2)
        d1 = (d2 @ W2.T) * slope(of[0] if of else h1)
        return (
            x.T @ d1, d1.sum(axis=0),
            h1.T @ d2, d2.sum(axis=0),
            h2.T @ d, d.sum(axis=0),
            d1 @ W1.T,
        )  # fmt: skip

    right = back(d)
    d2 = (d @ W3.T) * (1 - h2**2)
    out = h2 @ W3 + b3
    sum1 = x @ W1 + b1
    sum2 = h1 @ W2 + b2
    bare = np.tanh(x @ W1)
    return {
        "slope-forgotten": back(d, no_slope),
        "slope-forgotten 2": back(d, no_slope, of_tanh),
        "slope-forgotten 3": back(d, second=no_slope),
        "dx-before-the-slope": (*right[:6], d2 @ W2.T @ W1.T),
        "dx-with-input-slope": (*right[:6], right[6] * (1 - x**2)),
        "slope-of-h": back(d, lambda h: 1 - np.tanh(h) ** 2),
        "mse-again": back(2 * d / d.size),
        "dx-mean": (*right[:6], right[6] / len(x)),
        "slope-at-the-end": back(d * (1 - out**2)),
        "dx-of-the-hidden": lambda: (*right[:6], d2 @ W2.T),
        "slope-at-the-end 2": back(d * (1 - np.tanh(out) ** 2)),
        "slope-of-the-sum": back(d, of=(sum1, sum2)),
        "no-biases": back(d, h1=bare, h2=np.tanh(bare @ W2)),
        "slope-of-relu": back(d, lambda h: h > 0),
        "slope-of-relu 2": back(d, second=lambda h: h > 0),
        "mean-again": (*(a / len(x) for a in right[:6]), right[6]),
        "dx-accumulated": (*right[:6], np.cumsum(right[6], axis=0)),
    }


@row.right  # By the complex step, entry by entry.
def _(x, d, W1, b1, W2, b2, W3, b3):
    def loss(W1, b1, W2, b2, W3, b3, x):
        h = np.tanh(np.tanh(x @ W1 + b1) @ W2 + b2)
        return np.sum(d * (h @ W3 + b3))

    arrays = [W1, b1, W2, b2, W3, b3, x]
    grads = []
    for i, array in enumerate(arrays):
        grad = np.zeros(array.shape)
        for at in np.ndindex(array.shape):
            some = [a.astype(complex) for a in arrays]
            some[i][at] += 1e-30j
            grad[at] = loss(*some).imag / 1e-30
        grads.append(grad)
    return tuple(grads)


@row.right  # Row by row, with outer products, and the slope as 1 / cosh^2.
def _(x, d, W1, b1, W2, b2, W3, b3):
    grads = [np.zeros(a.shape) for a in (W1, b1, W2, b2, W3, b3, x)]
    for i in range(len(x)):
        z1 = x[i] @ W1 + b1
        z2 = np.tanh(z1) @ W2 + b2
        d3 = d[i]
        d2 = W3 @ d3 / np.cosh(z2) ** 2
        d1 = W2 @ d2 / np.cosh(z1) ** 2
        for k, (h, e) in enumerate(((x[i], d1), (np.tanh(z1), d2), (np.tanh(z2), d3))):
            grads[2 * k] += np.outer(h, e)
            grads[2 * k + 1] += e
        grads[6][i] = W1 @ d1
    return tuple(grads)


@row.right  # With a list of layers, from the last to the first.
def _(x, d, W1, b1, W2, b2, W3, b3):
    outputs = [x]
    for W, b in ((W1, b1), (W2, b2)):
        outputs.append(np.tanh(outputs[-1] @ W + b))
    grads = []
    for k, W in reversed(list(enumerate((W1, W2, W3)))):
        h = outputs[k]
        grads = [h.T @ d, np.ones(len(x)) @ d, *grads]
        d = d @ W.T
        if k > 0:
            d = d * (1 - h * h)
    return (*grads, d)


@row.spans
def _(rng):
    x = rng.numbers(-1, 1, 3, 2)
    for size, of_d in ((1e-3, 1e-5), (4.0, 10.0)):
        arrays = (size * a for a in net(rng, 2, 3, 2, 2))
        yield 4.0 * x, of_d * rng.numbers(-1, 1, 3, 2), *arrays

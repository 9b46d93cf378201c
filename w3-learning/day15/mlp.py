"""15.4 `mlp(x, W1, b1, W2, b2, W3, b3)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Matrix, Row

from .nets import net, problems


def complex_ones(rng):
    """Yield networks one of whose arrays is complex, as the complex step needs."""
    for x, _, *arrays in list(problems(rng))[:2]:
        for i, array in enumerate(arrays):
            some = list(arrays)
            some[i] = array + 1j * rng.numbers(-0.5, 0.5, *array.shape)
            yield x, *some


row = Row(
    Matrix((None, None)),
    held_out=[
        HeldOut(
            "imaginary-lost",
            "Your function is correct for real weights, but it loses the imaginary "
            "part of complex weights. The lab tests your gradient with the complex "
            "step. Do not use `float()`, `.real` or `np.maximum`, and do not write "
            "results into an array of real numbers.",
            complex_ones,
        )
    ],
)


@row.inputs
def _(rng):
    x = np.array([[1.0, 2]])
    eye, zero = np.eye(2), np.zeros(2)
    yield x, eye, zero, eye, zero, np.ones((2, 1)), np.array([0.5])
    for x, _, *arrays in problems(rng):
        yield x, *arrays


@row.wrongs
def _(x, W1, b1, W2, b2, W3, b3):
    """tanh-at-the-end: your code also applies tanh to the output. The output layer
      should be linear, because an action can lie outside the interval from -1 to 1
    relu: your code applies max(0, z) in the hidden layers. Use tanh(z) instead
    logistic: your code applies the logistic function 1 / (1 + exp(-z)) in the hidden
      layers. Use tanh(z) instead
    """

    def by(f):
        return f(f(x @ W1 + b1) @ W2 + b2) @ W3 + b3

    return {
        "tanh-at-the-end": np.tanh(by(np.tanh)),
        "relu": by(lambda z: np.maximum(z.real, 0)),
        "logistic": by(lambda z: 1 / (1 + np.exp(-z))),
    }


@row.right  # Row by row, with columns.
def _(x, W1, b1, W2, b2, W3, b3):
    rows = []
    for one in x:
        h = one
        for W, b in ((W1, b1), (W2, b2)):
            h = np.tanh(W.T @ h + b)
        rows.append(W3.T @ h + b3)
    return np.array(rows)


@row.right  # The bias as a weight of an input 1, and einsum.
def _(x, W1, b1, W2, b2, W3, b3):
    one = np.ones((len(x), 1))
    for W, b in ((W1, b1), (W2, b2)):
        x = np.tanh(np.einsum("ij,jk->ik", np.hstack([x, one]), np.vstack([W, b])))
    return np.hstack([x, one]) @ np.vstack([W3, b3])


@row.spans
def _(rng):
    for size in (1e-4, 4.0):
        x = size * rng.numbers(-1, 1, 3, 2)
        yield x, *(size * one for one in net(rng, 2, 3, 2, 2))

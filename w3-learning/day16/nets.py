"""Networks and rows as questions: small, every size different, numbers to be typed."""

import numpy as np

from labkit.judge import Matrix, Vector

NAMES = ("W1", "b1", "W2", "b2", "W3", "b3", "x")
GRADIENTS = tuple(
    (Vector if name[0] == "b" else Matrix)(
        (None,) if name[0] == "b" else (None, None),
        called=f"the gradient with respect to {name}",
    )
    for name in NAMES
)


def one(*weights):
    """Return a network with one unit per layer, these weights, and biases 0."""
    return tuple(a for w in weights for a in (np.full((1, 1), float(w)), np.zeros(1)))


def net(rng, a, h, g, m, last=1.0):
    """Return the six arrays of a network; the last layer's times `last`."""
    sizes = ((a, h), (h,), (h, g), (g,), (g, m), (m,))
    arrays = [rng.numbers(-0.9, 0.9, *size) for size in sizes]
    return (*arrays[:4], last * arrays[4], last * arrays[5])


def problems(rng):
    """Yield rows of inputs and gradients of the outputs, with networks."""
    for n, *sizes in (
        (4, 3, 4, 2, 2),  # all sizes differ
        (3, 2, 3, 3, 2),  # a square second layer
        (2, 3, 3, 2, 2),  # a square first layer
        (1, 2, 3, 4, 2),  # one row
        (5, 3, 2, 3, 1),  # one output
    ):
        x = rng.numbers(-1.5, 1.5, n, sizes[0])
        yield x, rng.numbers(-1, 1, n, sizes[3]), *net(rng, *sizes)
    x = rng.numbers(-1, 1, 3, 2)
    yield x, rng.numbers(-1, 1, 3, 2), *net(rng, 2, 3, 2, 2, last=0.0)

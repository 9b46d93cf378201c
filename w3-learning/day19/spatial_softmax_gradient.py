"""19.6 `spatial_softmax_gradient`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.kinds import Kind

from .images import maps

row = Row(Kind((None, None, None)))


@row.inputs
def _(rng):
    one = np.array([[1.0, 0]])
    yield np.log([[[1.0, 3]]]), np.array([0.0, 1]), np.array([5.0]), 1.0, one
    for some, *others in maps(rng):
        yield some, *others, rng.numbers(-2, 2, len(some), 2)


row.cases(
    a_temperature_of_1=lambda maps, xs, ys, temperature, d: temperature == 1,
    another_temperature=lambda maps, xs, ys, temperature, d: temperature != 1,
)


@row.wrongs
def _(maps, xs, ys, temperature, d):
    """mean-not-taken-off: your code does not subtract the expected value of d_x x + d_y
      y, where (d_x, d_y) is the map's row of d. Subtract this value, because a larger
      map entry reduces all other weights
    temperature-forgotten: your code does not divide the gradient by the temperature.
      The maps are divided by the temperature before the softmax, so the chain rule
      gives the factor 1 / temperature
    p-1-minus-p: your code uses only the factor p (1 - p), the derivative of a weight p
      with respect to its own softmax input. The other weights change too, so include
      their derivatives
    """
    e = np.exp((maps - maps.max(axis=(1, 2), keepdims=True)) / temperature)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    at = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]
    centred = at - (p * at).sum(axis=(1, 2), keepdims=True)
    return {
        "mean-not-taken-off": p * at / temperature,
        "temperature-forgotten": p * centred,
        "p-1-minus-p": p * (1 - p) * at / temperature,
    }


row.at_least_0(temperature="a divisor above 0")


@row.right  # Map by map, with the matrix of all derivatives.
def _(maps, xs, ys, temperature, d):
    X, Y = np.meshgrid(xs, ys)
    slopes = []
    for one, (dx, dy) in zip(maps, d):
        p = np.exp((one - one.max()) / temperature).ravel()
        p = p / p.sum()
        J = (np.diag(p) - np.outer(p, p)) / temperature
        slopes.append((J @ (dx * X + dy * Y).ravel()).reshape(one.shape))
    return np.array(slopes)


@row.right  # Distances from the expected point.
def _(maps, xs, ys, temperature, d):
    p = np.exp((maps - np.max(maps, axis=(1, 2), keepdims=True)) / temperature)
    p /= np.sum(p, axis=(1, 2), keepdims=True)
    x = np.sum(p * xs, axis=(1, 2))
    y = np.sum(p * ys[:, None], axis=(1, 2))
    dx = (xs - x[:, None])[:, None, :] * d[:, 0, None, None]
    dy = (ys - y[:, None])[:, :, None] * d[:, 1, None, None]
    return p * (dx + dy) / temperature


@row.spans
def _(rng):
    xs, ys = np.array([-0.1, 0.0, 0.1]), np.array([-0.04, 0.04])
    for heat, size, slope in ((1.0, 1e-3, 0.01), (0.1, 9.0, 9.0)):
        some = size * rng.numbers(-1, 1, 2, 2, 3)
        yield some, xs, ys, heat, slope * rng.numbers(-1, 1, 2, 2)

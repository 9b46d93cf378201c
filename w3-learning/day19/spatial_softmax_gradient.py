"""19.6 `spatial_softmax_gradient`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row
from labkit.judge.kinds import Kind
from robo47.pixels import spatial_softmax_gradient

from .images import dark_maps, large_maps, maps


def with_d(rng, calls):
    """Yield calls of `spatial_softmax`, each with a gradient of the loss."""
    for some, *others in calls:
        yield some, *others, rng.numbers(-2, 2, len(some), 2)


row = Row(
    Kind((None, None, None)),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is correct for small entries. For large entries, exp "
            "overflows or all weights of a map are 0, so your result is NaN. Subtract "
            "the largest entry of each map from that map before you divide by the "
            "temperature, as in task 19.5.",
            lambda rng: with_d(rng, large_maps(rng)),
        ),
        HeldOut(
            "not-for-minus-infinity",
            "Your function is correct for finite entries, but not for entries equal "
            "to -inf. Such an entry has weight 0, so its gradient should be 0.",
            lambda rng: with_d(rng, dark_maps(rng)),
        ),
    ],
)


@row.inputs
def _(rng):
    one = np.array([[1.0, 0]])
    yield np.log([[[1.0, 3]]]), np.array([0.0, 1]), np.array([5.0]), 1.0, one
    yield from with_d(rng, maps(rng))


row.cases(
    a_temperature_of_1=lambda maps, xs, ys, temperature, d: temperature == 1,
    another_temperature=lambda maps, xs, ys, temperature, d: temperature != 1,
)


@row.wrongs
def _(maps, xs, ys, temperature, d):
    """mean-not-taken-off: your code does not subtract the expected value of d_x * x +
      d_y * y, where (d_x, d_y) is the map's row of d. Subtract this value, because
      raising one entry of a map reduces the weights of all other entries
    temperature-forgotten: your code does not divide the gradient by the temperature.
      The maps are divided by the temperature before the softmax, so the chain rule
      gives the factor 1 / temperature
    p-1-minus-p: your code uses only the factor p * (1 - p), the derivative of a weight
      p with respect to its own softmax input. Each input also changes all other
      weights, so include the derivatives of these weights
    plain-mean: your code subtracts the mean of d_x * x + d_y * y with equal weights,
      where (d_x, d_y) is the map's row of d. Subtract the expected value instead, which
      is the mean with the softmax weights
    only-x-centred: your code subtracts the expected value of d_x * x only, where (d_x,
      d_y) is the map's row of d. Subtract the expected value of d_x * x + d_y * y
      instead
    only-y-centred: your code subtracts the expected value of d_y * y only, where (d_x,
      d_y) is the map's row of d. Subtract the expected value of d_x * x + d_y * y
      instead
    mean-without-d: your code subtracts the expected value of x + y. Subtract the
      expected value of d_x * x + d_y * y instead, where (d_x, d_y) is the map's row of
      d
    maps-together: your code subtracts the sum of the expected values of all maps. The
      weights of each map depend only on that map, so subtract only that map's expected
      value
    """
    e = np.exp((maps - maps.max(axis=(1, 2), keepdims=True)) / temperature)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    at = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]
    centred = at - (p * at).sum(axis=(1, 2), keepdims=True)
    plain = (p * (xs + ys[:, None])).sum(axis=(1, 2), keepdims=True)
    x = (p * xs).sum(axis=(1, 2)) * d[:, 0]  # its part of the expected value
    y = (p * ys[:, None]).sum(axis=(1, 2)) * d[:, 1]
    return {
        "mean-not-taken-off": p * at / temperature,
        "temperature-forgotten": p * centred,
        "p-1-minus-p": p * (1 - p) * at / temperature,
        "plain-mean": p * (at - at.mean(axis=(1, 2), keepdims=True)) / temperature,
        "only-x-centred": p * (at - x[:, None, None]) / temperature,
        "only-y-centred": p * (at - y[:, None, None]) / temperature,
        "mean-without-d": p * (at - plain) / temperature,
        "maps-together": p * (at - np.sum(x + y)) / temperature,
    }


@row.wrong("overflows", hidden="exp does not overflow for the lab's maps")
def _(maps, xs, ys, temperature, d):
    p = np.exp(maps / temperature)
    p = p / p.sum(axis=(1, 2), keepdims=True)
    at = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]
    return p * (at - (p * at).sum(axis=(1, 2), keepdims=True)) / temperature


@row.wrong("not-for-minus-infinity", hidden="the lab's maps are finite")
def _(maps, xs, ys, temperature, d):
    finite = np.where(np.isinf(maps), 0, maps)
    return spatial_softmax_gradient(finite, xs, ys, temperature, d)


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

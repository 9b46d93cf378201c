"""19.5 `spatial_softmax(maps, xs, ys, temperature)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Matrix, Row
from robo47.pixels import spatial_softmax

from .images import dark_maps, large_maps, maps


def complex_maps(rng):
    """Yield complex maps, as the complex step needs."""
    for some, *others in list(maps(rng))[:3]:
        yield some + 1j * rng.numbers(-0.5, 0.5, *some.shape), *others


row = Row(
    Matrix((None, None)),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is correct for small entries. For large entries, exp "
            "overflows or all weights of a map are 0, so your result is NaN. Subtract "
            "the largest entry of each map from that map before you divide by the "
            "temperature. This subtraction does not change the weights.",
            large_maps,
        ),
        HeldOut(
            "not-for-minus-infinity",
            "Your function is correct for finite entries, but not for entries equal "
            "to -inf. Such an entry should have weight 0. Do not replace -inf, "
            "because exp(-inf) is 0.",
            dark_maps,
        ),
        HeldOut(
            "imaginary-lost",
            "Your function is correct for real maps, but it loses the imaginary part "
            "of complex maps. The lab tests your gradient with the complex step. Do "
            "not use `float()`, `.real` or `np.maximum`, and do not write results "
            "into an array of real numbers.",
            complex_maps,
        ),
    ],
)


@row.inputs
def _(rng):
    yield np.log([[[1.0, 3]]]), np.array([0.0, 1]), np.array([5.0]), 1.0
    yield from maps(rng)


row.cases(
    a_temperature_of_1=lambda maps, xs, ys, temperature: temperature == 1,
    another_temperature=lambda maps, xs, ys, temperature: temperature != 1,
)
row.cases(
    one_map=lambda maps, xs, ys, temperature: len(maps) == 1,
    several_maps=lambda maps, xs, ys, temperature: len(maps) > 1,
)


@row.wrongs
def _(maps, xs, ys, temperature):
    """rows-only: your weights sum to 1 in each row of a map. The weights should sum to
      1 over the whole map, so divide by the sum over rows and columns instead
    maps-together: your weights sum to 1 over all maps together. Each map is a separate
      channel, so the weights of each map should sum to 1
    argmax: your function returns the position of the largest entry. Return the expected
      position instead, because the gradient of the largest entry's position is 0 almost
      everywhere
    x-y-swapped: your result is (y, x). Return x first, where pixel [i, j] is at x =
      xs[j] and y = ys[i]
    over-the-maps: your weights sum to 1 over the maps at each pixel. The weights of
      each map should sum to 1, so divide by the sum over rows and columns instead
    indices: your code averages the indices of rows and columns. Average the
      coordinates xs and ys instead
    softmax-of-sums: your code sums each map along one axis before it calls exp. Apply
      exp to each entry of the map first, and sum the weights afterwards
    """
    z = maps / temperature
    most = z.max(axis=(1, 2), keepdims=True)
    e = np.exp(z - most)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    rows = np.exp(z - z.max(axis=2, keepdims=True))
    rows = rows / rows.sum(axis=2, keepdims=True)
    over = np.exp(z - z.max(axis=0))
    over = over / over.sum(axis=0)
    together = np.exp(z - z.max())
    best = maps.reshape(len(maps), -1).argmax(axis=1)

    def soft(sums):
        e = np.exp(sums - sums.max(axis=1, keepdims=True))
        return e / e.sum(axis=1, keepdims=True)

    def at(p):
        return np.stack([(p * xs).sum((1, 2)), (p * ys[:, None]).sum((1, 2))], axis=1)

    return {
        "rows-only": at(rows),
        "maps-together": at(together / together.sum()),
        "argmax": np.stack([xs[best % len(xs)], ys[best // len(xs)]], axis=1),
        "x-y-swapped": at(p)[:, ::-1],
        "over-the-maps": at(over),
        "indices": np.stack(
            [p.sum(axis=1) @ np.arange(len(xs)), p.sum(axis=2) @ np.arange(len(ys))],
            axis=1,
        ),
        "softmax-of-sums": np.stack(
            [soft(z.sum(axis=1)) @ xs, soft(z.sum(axis=2)) @ ys], axis=1
        ),
    }


SMALL = "exp does not overflow for the lab's maps"


@row.wrong("overflows", hidden=SMALL)  # Nothing is subtracted.
def _(maps, xs, ys, temperature):
    e = np.exp(maps / temperature)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    return np.stack([p.sum(axis=1) @ xs, p.sum(axis=2) @ ys], axis=1)


@row.wrong("overflows", hidden=SMALL)  # The largest entry of all maps is subtracted.
def _(maps, xs, ys, temperature):
    e = np.exp((maps - maps.max()) / temperature)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    return np.stack([p.sum(axis=1) @ xs, p.sum(axis=2) @ ys], axis=1)


@row.wrong("overflows", hidden=SMALL)  # The mean is subtracted.
def _(maps, xs, ys, temperature):
    e = np.exp((maps - maps.mean(axis=(1, 2), keepdims=True)) / temperature)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    return np.stack([p.sum(axis=1) @ xs, p.sum(axis=2) @ ys], axis=1)


@row.wrong("not-for-minus-infinity", hidden="the lab's maps are finite")
def _(maps, xs, ys, temperature):
    return spatial_softmax(np.where(np.isinf(maps), 0, maps), xs, ys, temperature)


row.at_least_0(temperature="a divisor above 0")


@row.right  # Map by map, with meshgrid.
def _(maps, xs, ys, temperature):
    X, Y = np.meshgrid(xs, ys)
    points = []
    for one in maps:
        weight = np.exp((one - np.max(one)) / temperature)
        weight = weight / np.sum(weight)
        points.append([np.sum(weight * X), np.sum(weight * Y)])
    return np.array(points)


@row.right  # As rows of pixels, and matrix products.
def _(maps, xs, ys, temperature):
    c, h, w = maps.shape
    z = maps.reshape(c, h * w) / temperature
    e = np.exp(z - z.max(axis=1, keepdims=True))
    places = np.column_stack([np.tile(xs, h), np.repeat(ys, w)])
    return (e @ places) / e.sum(axis=1, keepdims=True)


@row.spans
def _(rng):
    xs, ys = np.array([-0.1, 0.0, 0.1]), np.array([-0.04, 0.04])
    for heat, size in ((1.0, 700.0), (0.1, 1e-3), (0.1, 9.0)):
        yield size * rng.numbers(-1, 1, 3, 2, 3), xs, ys, heat

"""19.5 `spatial_softmax(maps, xs, ys, temperature)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Matrix, Row

from .images import maps


def complex_maps(rng):
    """Yield complex maps, as the complex step needs."""
    for some, *others in list(maps(rng))[:3]:
        yield some + 1j * rng.numbers(-0.5, 0.5, *some.shape), *others


def large_maps(rng):
    """Yield maps whose entries exceed what exp can represent, both signs."""
    for some, *others in list(maps(rng))[:3]:
        yield some + 3000.0, *others
        yield some - 3000.0, *others


row = Row(
    Matrix((None, None)),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is right for small entries. For large entries, exp "
            "overflows or all weights are 0, so your result is NaN. Subtract the "
            "largest entry of each map before exp: the weights do not change.",
            large_maps,
        ),
        HeldOut(
            "imaginary-lost",
            "Your function is right for real maps, but it loses the imaginary part of "
            "complex maps. The lab tests your gradient with the complex step, so use "
            "operations that keep the imaginary part: no float(), .real or np.maximum, "
            "and no array of floats that you fill.",
            complex_maps,
        ),
    ],
)


@row.inputs
def _(rng):
    yield np.log([[[1.0, 3]]]), np.array([0.0, 1]), np.array([5.0]), 1.0
    yield from maps(rng)
    dark = rng.numbers(-1, 1, 2, 2, 3)
    dark[:, 0, 1:] = -np.inf  # pixels of the weight 0
    yield dark, np.array([0.0, 1, 3]), np.array([-1.0, 2]), 0.6


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
    """rows-only: your weights sum to 1 in each row of a map. All weights of a map
      together should sum to 1, so divide by the sum over the rows and columns
    maps-together: your weights sum to 1 over all maps together. Each map is a separate
      channel, so the weights of each map should sum to 1
    argmax: your function returns the position of the largest entry. Return the expected
      position instead, because the gradient of the largest entry's position is 0 almost
      everywhere
    x-y-swapped: your result is (y, x). Return x first, where pixel [i, j] is at x =
      xs[j] and y = ys[i]
    """
    z = maps / temperature
    most = z.max(axis=(1, 2), keepdims=True)
    e = np.exp(z - most)
    p = e / e.sum(axis=(1, 2), keepdims=True)
    rows = np.exp(z - z.max(axis=2, keepdims=True))
    rows = rows / rows.sum(axis=2, keepdims=True)
    together = np.exp(z - z.max())
    best = maps.reshape(len(maps), -1).argmax(axis=1)

    def at(p):
        return np.stack([(p * xs).sum((1, 2)), (p * ys[:, None]).sum((1, 2))], axis=1)

    return {
        "rows-only": at(rows),
        "maps-together": at(together / together.sum()),
        "argmax": np.stack([xs[best % len(xs)], ys[best // len(xs)]], axis=1),
        "x-y-swapped": at(p)[:, ::-1],
    }


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

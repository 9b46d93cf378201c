"""Images, kernels and maps as questions: few pixels, no two sizes equal."""

import numpy as np


def pairs(rng):
    """Yield an image, a kernel that fits into it, and a stride."""
    for size, small, stride in (
        ((5, 4), (2, 3), 1),
        ((4, 4), (3, 3), 1),
        ((7, 6), (2, 2), 2),  # pixels are left over
        ((7, 8), (3, 2), 3),
        ((3, 5), (3, 5), 2),  # one window
        ((3, 4), (1, 1), 1),  # a kernel of one entry
    ):
        yield rng.numbers(-2, 2, *size), rng.numbers(-1, 1, *small), stride
    h, w, p, q, stride = (
        int(n) for n in rng.integers((5, 5, 2, 2, 1), (8, 8, 4, 4, 3))
    )
    yield rng.numbers(-2, 2, h, w), rng.numbers(-1, 1, p, q), stride
    some = rng.numbers(-1, 1, 3, 3)
    even = some + some[::-1, ::-1]
    yield rng.numbers(-2, 2, 5, 6), even, 1  # symmetric, but not its own transpose


def maps(rng):
    """Yield maps, the coordinates of their pixels, and a temperature."""
    for c, h, w, heat in (
        (1, 2, 3, 1.0),
        (2, 3, 2, 0.5),
        (3, 2, 4, 2.0),
        (2, 3, 3, 0.8),
    ):
        xs, ys = (np.sort(rng.numbers(-2, 2, n)) for n in (w, h))
        yield rng.numbers(-1, 1, c, h, w), xs, ys, heat
    yield (
        np.full((1, 2, 3), 4.0),
        np.array([0.0, 1, 5]),
        np.array([2.0, 3]),
        0.3,
    )  # flat
    c, h, w = (int(n) for n in rng.integers(2, 5, 3))
    yield (
        rng.numbers(0, 2, c, h, w),
        rng.numbers(-2, 2, w),
        rng.numbers(-2, 2, h),
        float(rng.numbers(0.4, 2)),
    )


def large_maps(rng):
    """Yield maps whose entries exceed what exp can represent.

    All entries of all maps are large, with either sign; or all entries of one map; or
    one entry of a map.
    """
    for some, *others in list(maps(rng))[:3]:
        yield some + 3000.0, *others
        yield some - 3000.0, *others
        yield some + 3000.0 * np.arange(len(some))[:, None, None], *others
        one = some.copy()
        one[:, 0, 0] += 3000.0
        yield one, *others


def dark_maps(rng):
    """Yield maps with entries of -inf, which have the weight 0."""
    for some, *others in list(maps(rng))[:3]:
        dark = some.copy()
        dark[:, 0, 1:] = -np.inf
        yield dark, *others

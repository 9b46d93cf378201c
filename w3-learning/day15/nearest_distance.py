"""15.9 `nearest_distance(known, asked)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    yield np.array([[0.0, 0], [3, 4]]), np.array([[0.0, 1]])
    yield np.array([[1.0, 2]]), np.array([[1.0, 2], [4, 6]])
    for n, m, d in ((5, 3, 2), (3, 6, 4), (8, 2, 1), (4, 4, 3)):
        yield rng.numbers(-2, 2, n, d), rng.numbers(-2, 2, m, d)


@row.wrongs
def _(known, asked):
    """squared: your result is the squared distance. Return its square root instead
    from-known: your code returns the distance from each row of `known` to the nearest
      row of `asked`. Return the distance from each row of `asked` to the nearest row of
      `known` instead
    column-by-column: your code chooses the nearest value in each column separately.
      Choose one nearest row for all columns instead
    mean-distance: your result is the mean of the distances to all rows of `known`.
      Return the smallest distance instead
    to-the-mean: your result is the distance to the mean of the rows of `known`. Return
      the distance to the nearest row of `known` instead
    index: your code returns the index of the nearest row. Return the distance to this
      row instead
    one-for-all: your code returns the smallest of all distances for every row of
      `asked`. Return the distance from each row of `asked` to its own nearest row of
      `known` instead
    city-block: your code sums the absolute differences of the columns. Return the
      Euclidean distance instead
    """
    apart = known[:, None] - asked
    d = np.linalg.norm(apart, axis=2)
    return {
        "squared": np.min(d**2, axis=0),
        "from-known": d.min(axis=1),
        "column-by-column": np.linalg.norm(np.abs(apart).min(axis=0), axis=1),
        "mean-distance": d.mean(axis=0),
        "to-the-mean": np.linalg.norm(asked - known.mean(axis=0), axis=1),
        "index": d.argmin(axis=0),
        "one-for-all": np.full(len(asked), d.min()),
        "city-block": np.abs(apart).sum(axis=2).min(axis=0),
    }


@row.right  # Two loops.
def _(known, asked):
    found = np.full(len(asked), np.inf)
    for i, one in enumerate(asked):
        for other in known:
            found[i] = min(found[i], np.hypot.reduce(one - other) if len(one) > 1
                           else abs(one[0] - other[0]))  # fmt: skip
    return found


@row.right  # All at once.
def _(known, asked):
    return np.linalg.norm(asked[:, None, :] - known[None, :, :], axis=-1).min(-1)


@row.spans
def _(rng):
    for size in (1e-4, 1e3):
        yield size * rng.numbers(-1, 1, 4, 2), size * rng.numbers(-1, 1, 3, 2)

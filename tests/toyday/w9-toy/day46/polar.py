"""46.5 `polar(x, y)`: two numbers."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(
    (Scalar(unit="m", called="the distance"), Scalar(unit="rad", called="the angle")),
    truth=lambda x, y: (np.hypot(x, y), np.arctan2(y, x)),
    near=1e-4,
)


@row.inputs
def _(rng):
    yield from (tuple(map(float, v)) for v in rng.numbers(-1, 1, 6, 2))


@row.wrong
def arctan_of_the_ratio(x, y):
    """the angle is arctan(y / x), which knows two quadrants only"""
    return np.hypot(x, y), np.arctan(y / x)

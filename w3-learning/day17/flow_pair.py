"""17.8 `flow_pair(x0, noise, t)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Slip

row = Row(
    (
        Matrix((None, None), called="the point"),
        Matrix((None, None), called="the velocity"),
    ),
    slips=(
        Slip(
            "^ValueError: operands could not be broadcast",
            r"\bt\b",
            "one-per-row",
            "Your function stops because it multiplies t, of shape (n,), by an array "
            "of shape (n, d). Make t a column, `t[:, None]`, because t has one number "
            "per row.",
        ),
    ),
)


@row.inputs
def _(rng):
    yield np.array([[2.0]]), np.array([[1.0]]), np.array([0.25])
    for n, d in ((3, 2), (2, 4), (4, 1), (3, 3)):
        yield rng.numbers(-2, 2, n, d), rng.numbers(-2, 2, n, d), rng.numbers(0, 1, n)
    yield rng.numbers(-2, 2, 3, 2), rng.numbers(-2, 2, 3, 2), np.array([0.0, 0.5, 1])


row.at_least_0(t="from 0 to 1")


@row.wrongs
def _(x0, noise, t):
    """diffusion-roots: your code uses the square roots of t and 1 - t as factors, as in
      diffusion. Use t and 1 - t instead, because the point moves along a straight line
    time-reversed: your point is the data at t = 0 and the noise at t = 1. Swap the
      factors t and 1 - t, because the point should move from the noise to the data
    other-convention: your point moves from the data to the noise. Swap the factors t
      and 1 - t, and negate the velocity, because the point should move from the noise
      to the data
    to-go: your velocity is the displacement from the point to the data. Use the
      displacement from the noise to the data instead, because the point covers this
      displacement between t = 0 and t = 1
    distance-so-far: your velocity is the displacement from the noise to the point. Use
      the displacement from the noise to the data instead, because the point covers this
      displacement between t = 0 and t = 1
    divided-by-the-rest: your code divides x0 - noise by 1 - t. Omit this division,
      because the point moves by x0 - noise between t = 0 and t = 1
    division-by-0: your code divides the displacement from the noise to the point by t,
      which gives 0 / 0 at t = 0. Compute the velocity from the data and the noise,
      without a division
    """
    t = t[:, None]
    at = (1 - t) * noise + t * x0
    back = (1 - t) * x0 + t * noise
    return {
        "diffusion-roots": (np.sqrt(1 - t) * noise + np.sqrt(t) * x0, x0 - noise),
        "time-reversed": (back, x0 - noise),
        "other-convention": (back, noise - x0),
        "to-go": (at, x0 - at),
        "distance-so-far": (at, at - noise),
        "divided-by-the-rest": (at, (x0 - noise) / (1 - t)),
        "division-by-0": (at, (at - noise) / t),
    }


@row.right  # From the noise along the velocity.
def _(x0, noise, t):
    velocity = x0 - noise
    return noise + t.reshape(-1, 1) * velocity, velocity


@row.right  # Row by row.
def _(x0, noise, t):
    at = np.array([(1 - s) * e + s * x for x, e, s in zip(x0, noise, t)])
    return at, np.array([x - e for x, e in zip(x0, noise)])


@row.spans
def _(rng):
    for size in (1e-3, 10.0):
        x0, noise = size * rng.numbers(-1, 1, 2, 3, 2)
        yield x0, noise, np.array([0.001, 0.5, 0.999])

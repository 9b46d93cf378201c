"""17.2 `add_noise(x0, noise, abar)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Slip

row = Row(
    Matrix((None, None)),
    slips=(
        Slip(
            "^ValueError: operands could not be broadcast",
            r"abar",
            "one-per-row",
            "Your function stops because it multiplies abar, of shape (n,), by an "
            "array of shape (n, d). Make abar a column, `abar[:, None]`, because abar "
            "has one number per row.",
        ),
    ),
)


@row.inputs
def _(rng):
    yield np.array([[1.0]]), np.array([[0.5]]), np.array([0.36])
    for n, d in ((3, 2), (2, 4), (4, 1), (3, 3)):
        yield rng.numbers(-2, 2, n, d), rng.numbers(-2, 2, n, d), rng.numbers(0, 1, n)
    yield rng.numbers(-2, 2, 3, 2), rng.numbers(-2, 2, 3, 2), np.array([0.0, 0.5, 1])


row.cases(
    one_column=lambda x0, noise, abar: x0.shape[1] == 1,
    several_columns=lambda x0, noise, abar: x0.shape[1] > 1,
)


row.at_least_0(abar="a fraction")


@row.wrongs
def _(x0, noise, abar):
    """roots-forgotten: your code uses the factors abar and 1 - abar. Use the square
      roots of these factors instead, because abar and 1 - abar are fractions of the
      power, and the power is proportional to the square of the amplitude
    noise-root-forgotten: your code multiplies the noise by 1 - sqrt(abar). Use sqrt(1 -
      abar) instead, because the squares of the two factors should sum to 1
    abar-as-factor: your code uses the factors abar and sqrt(1 - abar^2). Use sqrt(abar)
      and sqrt(1 - abar) instead, because abar is a fraction of the power, and the power
      is proportional to the square of the amplitude
    """
    a = abar[:, None]
    keep = np.sqrt(a)
    return {
        "roots-forgotten": a * x0 + (1 - a) * noise,
        "noise-root-forgotten": keep * x0 + (1 - keep) * noise,
        "abar-as-factor": a * x0 + np.sqrt(1 - a**2) * noise,
    }


@row.right  # Row by row.
def _(x0, noise, abar):
    rows = []
    for data, eps, a in zip(x0, noise, abar):
        rows.append(a**0.5 * data + (1 - a) ** 0.5 * eps)
    return np.array(rows)


@row.right  # By the angle whose cosine is the root.
def _(x0, noise, abar):
    angle = np.arccos(np.sqrt(abar))
    return (np.cos(angle) * x0.T + np.sin(angle) * noise.T).T


@row.spans
def _(rng):
    for size in (1e-3, 10.0):
        x0, noise = size * rng.numbers(-1, 1, 2, 3, 2)
        yield x0, noise, np.array([2e-7, 0.9999, 0.5])

"""17.7 `width_kept(abars, sigma)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    yield np.array([0.36]), 0.1
    for k in (2, 3, 5, 8):
        yield np.sort(rng.numbers(0.01, 0.99, k)), float(rng.numbers(0.05, 1.5))
    yield np.array([0.001, 0.2]), 0.3
    yield np.array([0.4, 0.7]), 1.0


row.cases(
    one_step=lambda abars, sigma: len(abars) == 1,
    several_steps=lambda abars, sigma: len(abars) > 1,
)


row.at_least_0(abars="fractions", sigma="a standard deviation", answer="a fraction")


@row.wrongs
def _(abars, sigma):
    """width-forgotten: in your code, the vectors are (sqrt(abar), sqrt(1 - abar)).
      Their first component is the standard deviation of the signal, sigma sqrt(abar)
    first-and-last-only: your result is the cosine of the angle between the first
      direction and the last. Each step loses the cosine of its own angle: multiply them
    last-step-forgotten: in your code, the step from the last level to abar = 1 is
      missing
    sum: your cosines are added. Each step multiplies the width, so multiply them
    width: your result is the standard deviation that is left. Return it as a fraction
      of sigma
    dots: your factors are the products of the vectors, not divided by their lengths.
      The cosine is the product divided by both lengths
    """
    levels = np.append(abars, 1)

    def cosines(first, second):
        u = np.stack([first, second])
        dots = np.sum(u[:, 1:] * u[:, :-1], axis=0)
        sizes = np.linalg.norm(u, axis=0)
        return dots / sizes[1:] / sizes[:-1], dots

    right, dots = cosines(sigma * np.sqrt(levels), np.sqrt(1 - levels))
    ends = levels[[0, -1]]
    return {
        "width-forgotten": np.prod(cosines(np.sqrt(levels), np.sqrt(1 - levels))[0]),
        "first-and-last-only": cosines(sigma * np.sqrt(ends), np.sqrt(1 - ends))[0][0],
        "last-step-forgotten": np.prod(right[:-1]),
        "sum": np.sum(right),
        "width": sigma * np.prod(right),
        "dots": np.prod(dots),
    }


@row.right  # With the products of the vectors and their lengths.
def _(abars, sigma):
    levels = np.append(abars, 1.0)
    u = np.stack([sigma * np.sqrt(levels), np.sqrt(1 - levels)], axis=1)
    u = u / np.linalg.norm(u, axis=1)[:, None]
    return np.prod((u[1:] * u[:-1]).sum(axis=1))


@row.right  # In a loop, as factors of the width, whose lengths cancel.
def _(abars, sigma):
    kept = 1.0
    for a, b in zip(abars, np.append(abars[1:], 1)):
        dot = sigma**2 * np.sqrt(a * b) + np.sqrt((1 - a) * (1 - b))
        kept *= dot / (sigma**2 * a + 1 - a)
    return kept * np.sqrt(sigma**2 * abars[0] + 1 - abars[0]) / sigma


@row.spans
def _(rng):
    yield np.array([2e-7, 0.001, 0.3, 0.9996]), 0.1
    yield np.linspace(0.001, 0.999, 100), 0.2
    yield np.array([2.4e-7]), 0.1

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
    yield rng.numbers(0.1, 0.9, 1), float(rng.numbers(0.05, 1.5))


row.cases(
    one_step=lambda abars, sigma: len(abars) == 1,
    several_steps=lambda abars, sigma: len(abars) > 1,
)


row.at_least_0(abars="fractions", sigma="a standard deviation", answer="a fraction")


@row.wrongs(
    hidden={
        "pure-noise-first": "the lab's first level is nearly pure noise",
        "start-1": "the lab's first level is nearly pure noise",
    }
)
def _(abars, sigma):
    """width-forgotten: your code uses the vector (sqrt(abar), sqrt(1 - abar)) at each
      level. Multiply the first entry by sigma, because the standard deviation of the
      signal is sigma * sqrt(abar)
    first-and-last-only: your function returns the cosine of the angle between the first
      and the last direction. Return the product of the cosines of the angles of all
      steps instead, because each step multiplies the width by the cosine of its angle
    last-step-forgotten: your code omits the step from the last level to abar = 1.
      Multiply the result by the cosine of the angle of this step as well
    last-step-forgotten 2: your code omits the step from the last level to abar = 1 if
      `abars` has several entries. Multiply the result by the cosine of the angle of
      this step as well
    last-level-0: your code ends with a step to abar = 0, which is pure noise. The last
      step should lead to abar = 1, which is the data without noise
    last-level-first: your code puts abar = 1 before the other levels. Put abar = 1
      after the other levels instead, because the last step leads to abar = 1
    sines: your code multiplies the sines of the angles. Use the cosines instead,
      because each step multiplies the width by the cosine of its angle
    pure-noise-first: your code adds a step from abar = 0 to the first level. Omit this
      step, because the first step starts at the first level
    mean: your function returns the mean of the cosines. Each step multiplies the width
      by the cosine of its angle, so return the product of the cosines
    sum: your function returns the sum of the cosines. Each step multiplies the width by
      the cosine of its angle, so return the product of the cosines
    width: your function returns the standard deviation after all steps. Divide this
      standard deviation by sigma to obtain the fraction that the steps keep
    start-1: your code starts from the standard deviation 1. Start from the standard
      deviation of the noisy data at the first level instead, which is the norm of the
      first vector
    lengths-kept: your result contains an extra factor, the norm of the last vector
      divided by the norm of the first. Divide each dot product by the norms of both
      vectors, which gives the cosine of the angle
    dots: your code multiplies the dot products of successive vectors. Divide each dot
      product by the norms of both vectors first, which gives the cosine of the angle
    """
    levels = np.append(abars, 1)

    def cosines(first, second):
        u = np.stack([first, second])
        dots = np.sum(u[:, 1:] * u[:, :-1], axis=0)
        sizes = np.linalg.norm(u, axis=0)
        return dots / sizes[1:] / sizes[:-1], dots

    u = np.stack([sigma * np.sqrt(levels), np.sqrt(1 - levels)])
    sizes = np.linalg.norm(u, axis=0)
    right, dots = cosines(sigma * np.sqrt(levels), np.sqrt(1 - levels))
    ends = levels[[0, -1]]
    return {
        "width-forgotten": np.prod(cosines(np.sqrt(levels), np.sqrt(1 - levels))[0]),
        "first-and-last-only": cosines(sigma * np.sqrt(ends), np.sqrt(1 - ends))[0][0],
        "last-step-forgotten": np.prod(right[:-1]),
        "last-step-forgotten 2": np.prod(right[: max(len(abars) - 1, 1)]),
        "last-level-0": np.prod(right[:-1]) * np.sqrt(1 - abars[-1]) / sizes[-2],
        "last-level-first": np.prod(right[:-1]) * u[0, 0] / sizes[0],
        "sines": np.prod(np.sqrt(np.maximum(1 - right**2, 0))),
        "pure-noise-first": np.prod(right) * np.sqrt(1 - abars[0]) / sizes[0],
        "mean": np.mean(right),
        "start-1": np.prod(right) / sizes[0],
        "lengths-kept": np.prod(right) * sizes[-1] / sizes[0],
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

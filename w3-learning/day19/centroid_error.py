"""19.7 `centroid_error(spacing, sigma)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(scale=0.01))


@row.inputs
def _(rng):
    yield 1.0, 0.5
    yield 0.1, 0.05
    for spacing, ratio in ((1.0, 0.3), (2.0, 0.4), (0.5, 0.6), (3.0, 0.25)):
        yield spacing, spacing * ratio
    yield float(rng.numbers(0.5, 3)), float(rng.numbers(0.2, 0.5))


row.cases(
    a_spacing_of_1=lambda spacing, sigma: spacing == 1,
    another_spacing=lambda spacing, sigma: spacing != 1,
)


@row.wrongs
def _(spacing, sigma):
    """in-pixels: your function returns the error in pixels. Multiply this error by the
      spacing, so that the result has the unit of the arguments
    amplitude-of-the-sum: your code uses the amplitude of the first term of Poisson's
      sum as the error. The error is sigma^2 times the derivative of this sum with
      respect to the position
    twice-the-first-frequency: your code uses the exponent of the second term of
      Poisson's summation formula. Use the exponent of the first term, which has a
      period of one pixel
    """
    r = sigma / spacing
    decay = np.exp(-2 * np.pi**2 * r**2)
    return {
        "in-pixels": 4 * np.pi * r**2 * decay,
        "amplitude-of-the-sum": 2 * decay * spacing,
        "twice-the-first-frequency": 4 * np.pi * r**2 * decay**4 * spacing,
    }


row.at_least_0(spacing="a distance", sigma="a width", answer="a size")


@row.right  # With the frequency of the pixels.
def _(spacing, sigma):
    w = 2 * np.pi / spacing
    return 2 * w * sigma**2 * np.exp(-0.5 * (w * sigma) ** 2)


row.spans(spacing=(0.01, 100.0), sigma=(0.03, 0.06))

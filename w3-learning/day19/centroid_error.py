"""19.7 `centroid_error(spacing, sigma)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Case, Finding, Row, Scalar

AGREES = 1e-3  # relative: the maximum is searched on a grid


def of_all_frequencies(case: Case) -> Finding | None:
    """Say that the errors are the largest ones of sampled centroids."""
    for spacing, sigma, mine in zip(*case.arguments, case.S):
        if abs(mine / largest(spacing, sigma) - 1) > AGREES:
            return None
    return Finding(
        "all-frequencies",
        "Your function includes all frequencies in the largest error. The task "
        "considers only the lowest frequency, so use the first term of Poisson's sum.",
    )


def largest(spacing, sigma):
    """Return the largest error of the centroid of samples, by trial."""
    n = spacing * np.arange(-30, 31)[:, None]
    u = np.linspace(0, spacing / 2, 401)
    light = np.exp(-((n - u) ** 2) / (2 * sigma**2))
    return np.max(np.abs(np.sum(n * light, axis=0) / np.sum(light, axis=0) - u))


row = Row(Scalar(scale=0.01), unnamed=of_all_frequencies, unnamed_names=True)


@row.inputs
def _(rng):
    yield 1.0, 0.5
    yield 0.1, 0.05
    for spacing, ratio in ((1.0, 0.3), (2.0, 0.4), (0.5, 0.6), (30.0, 0.25)):
        yield spacing, spacing * ratio
    yield float(rng.numbers(0.5, 3)), float(rng.numbers(0.2, 0.5))


row.cases(
    a_spacing_of_1=lambda spacing, sigma: spacing == 1,
    another_spacing=lambda spacing, sigma: spacing != 1,
)


SECOND = "at the lab's blur the second term of the sum is 5e-9"


@row.wrongs(hidden={"divided-by-the-sum": SECOND})
def _(spacing, sigma):
    """in-pixels: your function returns the error in pixels. Multiply this error by the
      spacing, so that the result has the unit of the arguments
    amplitude-of-the-sum: your code uses the amplitude of the first term of Poisson's
      sum as the error. The error is sigma^2 times the derivative of this term with
      respect to the position
    twice-the-first-frequency: your code uses the exponent of the second term of
      Poisson's sum. Use the exponent of the first term instead, because this term has
      the lowest frequency
    without-2-pi: your code omits a factor of 2 * pi. The derivative of cos(2 * pi * u)
      with respect to u contains this factor
    inverted: your code divides the spacing by sigma. Divide sigma by the spacing
      instead, which gives the blur in pixels
    divided-by-the-sum: your code divides by Poisson's sum, including its second term.
      Omit this division, because the task considers only the lowest frequency
    unit-squared: your code uses sigma^2 as a factor, so the result is not a length. Use
      (sigma / spacing)^2 instead, and multiply the result by the spacing
    """
    r = sigma / spacing
    decay = np.exp(-2 * np.pi**2 * r**2)
    return {
        "in-pixels": 4 * np.pi * r**2 * decay,
        "amplitude-of-the-sum": 2 * decay * spacing,
        "twice-the-first-frequency": 4 * np.pi * r**2 * decay**4 * spacing,
        "without-2-pi": 2 * r**2 * decay * spacing,
        "inverted": 4 * np.pi / r**2 * np.exp(-2 * np.pi**2 / r**2) * spacing,
        "divided-by-the-sum": 4 * np.pi * r**2 * decay * spacing / (1 - 2 * decay**4),
        "unit-squared": 4 * np.pi * sigma**2 * decay,
    }


row.wrong("all-frequencies", hidden=SECOND)(lambda *call: largest(*call))


row.at_least_0(spacing="a distance", sigma="a width", answer="a size")


@row.right  # With the frequency of the pixels.
def _(spacing, sigma):
    w = 2 * np.pi / spacing
    return 2 * w * sigma**2 * np.exp(-0.5 * (w * sigma) ** 2)


row.spans(spacing=(0.01, 100.0), sigma=(0.03, 0.06))

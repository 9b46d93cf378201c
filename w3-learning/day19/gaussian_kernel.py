"""19.2 `gaussian_kernel(sigma, half)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None), scale=0.1))


@row.inputs
def _(rng):
    yield 1.0, 1
    yield 0.8, 0  # one pixel
    yield from ((0.5, 1), (1.5, 2), (3.0, 2), (1.2, 4))
    yield float(rng.numbers(0.5, 2.5)), int(rng.integers(1, 5))


row.cases(
    one_pixel=lambda sigma, half: half == 0,
    several_pixels=lambda sigma, half: half > 0,
)


@row.wrongs
def _(sigma, half):
    """not-normalised: your code does not normalise the kernel. Divide all entries by
      their sum, so that the blur does not change the brightness of the image
    by-the-integral: your code divides the kernel by 2 * pi * sigma^2, the integral of
      the Gaussian. The sum over the pixels differs from this integral, so divide by the
      sum of the entries instead
    rows-normalised: your code normalises each row of the kernel separately. All entries
      of the kernel together should sum to 1, so divide by the sum of the whole kernel
    added: your code adds the Gaussians along x and along y. Multiply these Gaussians
      instead, because the Gaussian in the plane is their product
    square-of-the-sum: your code uses (x + y)^2 as the squared distance from the centre.
      Use x^2 + y^2 instead
    one-short: your code uses coordinates from -half to half - 1. Use coordinates from
      -half to half instead, so that the kernel has 2 * half + 1 rows and columns
    from-minus-1-to-1: your code uses coordinates from -1 to 1. Use coordinates from
      -half to half instead, because `sigma` is in pixels
    """
    at = np.arange(-half, half + 1)
    d2 = at**2 + at[:, None] ** 2
    g = np.exp(-d2 / (2 * sigma**2))
    row = np.exp(-(at**2) / (2 * sigma**2))
    slanted = np.exp(-((at + at[:, None]) ** 2) / (2 * sigma**2))
    short = g[:-1, :-1]
    scaled = g ** (1 / half**2) if half else g
    return {
        "not-normalised": g,
        "by-the-integral": g / (2 * np.pi * sigma**2),
        "rows-normalised": g / g.sum(axis=1, keepdims=True),
        "added": np.add.outer(row, row) / np.add.outer(row, row).sum(),
        "square-of-the-sum": slanted / slanted.sum(),
        "one-short": short / short.sum(),
        "from-minus-1-to-1": scaled / scaled.sum(),
    }


row.at_least_0(sigma="a width", half="a number of pixels", answer="a weight")


@row.right  # A loop over the pixels.
def _(sigma, half):
    n = 2 * half + 1
    kernel = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            d2 = (i - half) ** 2 + (j - half) ** 2
            kernel[i, j] = np.exp(-0.5 * d2 / sigma**2)
    return kernel / np.sum(kernel)


@row.right  # One axis is normalised, and the density has its factor.
def _(sigma, half):
    x = np.linspace(-half, half, 2 * half + 1)
    row = np.exp(-0.5 * (x / sigma) ** 2) / np.sqrt(2 * np.pi * sigma**2)
    row = row / row.sum()
    return row[:, None] * row[None, :]


row.spans(sigma=(0.3, 5.0), half=(0, 29))

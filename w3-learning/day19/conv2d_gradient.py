"""19.4 `conv2d_gradient(image, kernel, stride, d)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .images import pairs

row = Row((
    Matrix((None, None), called="the gradient of the kernel"),
    Matrix((None, None), called="the gradient of the image"),
))  # fmt: skip


def outputs(image, kernel, stride):
    """Return the shape of the output of `conv2d`."""
    return tuple((a - b) // stride + 1 for a, b in zip(image.shape, kernel.shape))


@row.inputs
def _(rng):
    first = np.array([[1.0, 0], [0, 0]])
    yield np.arange(9.0).reshape(3, 3), np.array([[1.0, 0], [0, 2]]), 1, first
    for one in pairs(rng):
        yield *one, rng.numbers(-1, 1, *outputs(*one))


row.cases(
    one_window=lambda image, kernel, stride, d: d.size == 1,
    several_windows=lambda image, kernel, stride, d: d.size > 1,
)
row.cases(
    windows_that_overlap=lambda image, kernel, stride, d: (
        d.size > 1 and stride < max(kernel.shape)
    ),
    windows_apart=lambda image, kernel, stride, d: stride >= max(kernel.shape),
)


def windows(image, kernel, stride):
    """Return the windows of an image, (i, j, p, q)."""
    view = np.lib.stride_tricks.sliding_window_view(image, kernel.shape)
    return view[::stride, ::stride]


def of_image(image, kernel, stride, d, added=True):
    """Return the gradient of the image; added=False writes over what was there."""
    total = np.zeros(image.shape)
    p, q = kernel.shape
    for (i, j), one in np.ndenumerate(d):
        at = np.s_[i * stride : i * stride + p, j * stride : j * stride + q]
        total[at] = one * kernel + (total[at] if added else 0)
    return total


@row.wrongs
def _(image, kernel, stride, d):
    """kernel-flipped: your gradient of the kernel is flipped along both axes. `conv2d`
      does not flip the kernel, so entry [a, b] belongs to pixel [a, b] of each window
    image-by-flipped: your gradient of the image uses the flipped kernel. The window of
      output [i, j] receives d[i, j] times the kernel as it is
    overwritten: in your code, a window replaces what an earlier window wrote. A pixel
      that lies in several windows receives the sum of their gradients
    divided: your gradients are divided by the number of outputs. d is the gradient of
      the loss already, so sum over the outputs
    """
    of_kernel = np.einsum("ijab,ij->ab", windows(image, kernel, stride), d)
    right = of_image(image, kernel, stride, d)
    return {
        "kernel-flipped": (of_kernel[::-1, ::-1], right),
        "image-by-flipped": (
            of_kernel,
            of_image(image, kernel[::-1, ::-1], stride, d),
        ),
        "overwritten": (of_kernel, of_image(image, kernel, stride, d, added=False)),
        "divided": (of_kernel / d.size, right / d.size),
    }


row.at_least_0(stride="a number of pixels")


@row.right  # Entry by entry of the kernel, with shifted images.
def _(image, kernel, stride, d):
    h, w = d.shape
    of_kernel, of_image = np.zeros(kernel.shape), np.zeros(image.shape)
    for a in range(kernel.shape[0]):
        for b in range(kernel.shape[1]):
            rows = slice(a, a + stride * (h - 1) + 1, stride)
            columns = slice(b, b + stride * (w - 1) + 1, stride)
            of_kernel[a, b] = np.sum(d * image[rows, columns])
            of_image[rows, columns] += d * kernel[a, b]
    return of_kernel, of_image


@row.right  # By d with zeros between its entries, and correlations.
def _(image, kernel, stride, d):
    def correlate(some, by):
        view = np.lib.stride_tricks.sliding_window_view(some, by.shape)
        return np.einsum("ijab,ab->ij", view, by)

    p, q = kernel.shape
    wide = np.zeros((image.shape[0] - p + 1, image.shape[1] - q + 1))
    wide[::stride, ::stride] = d
    padded = np.pad(wide, ((p - 1, p - 1), (q - 1, q - 1)))
    return correlate(image, wide), correlate(padded, kernel[::-1, ::-1])


@row.spans
def _(rng):
    for size in (1e-4, 1e3):
        image, kernel = rng.numbers(-1, 1, 9, 8), rng.numbers(-2, 2, 3, 2)
        yield image, size * kernel, 2, size * rng.numbers(-1, 1, 4, 4)
    yield (
        rng.numbers(0, 1, 21, 21),
        rng.numbers(-1, 2, 5, 5),
        1,
        rng.numbers(-9, 9, 17, 17),
    )

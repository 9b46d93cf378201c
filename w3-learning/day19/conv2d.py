"""19.3 `conv2d(image, kernel, stride)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .images import pairs

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    yield np.arange(9.0).reshape(3, 3), np.array([[1.0, 0], [0, 2]]), 1
    yield from pairs(rng)


row.cases(
    a_stride_of_1=lambda image, kernel, stride: stride == 1,
    a_larger_stride=lambda image, kernel, stride: stride > 1,
)
row.cases(
    a_symmetric_kernel=lambda image, kernel, stride: bool(
        np.array_equal(kernel, kernel[::-1, ::-1])
    ),
    a_kernel_without_symmetry=lambda image, kernel, stride: (
        not np.array_equal(kernel, kernel[::-1, ::-1])
    ),
)


@row.wrongs
def _(image, kernel, stride):
    """flipped: your code flips the kernel along both axes, as in the mathematical
      convolution. Use the kernel without a flip, because `conv2d` computes the
      cross-correlation
    mean: your code divides each output by the number of entries of the kernel. Return
      the sum of the products without this division
    from-the-end: your code aligns the last window with the end of the image. Align the
      first window with pixel [0, 0], so that any unused pixels are at the end
    padded: your code pads the image with zeros, so it includes windows that extend
      beyond the image. Return one output for each window that lies inside the image
    """
    p, q = kernel.shape

    def by(some, kernel):
        windows = np.lib.stride_tricks.sliding_window_view(some, (p, q))
        return np.einsum("ijab,ab->ij", windows[::stride, ::stride], kernel)

    rest = tuple((a - b) % stride for a, b in zip(image.shape, (p, q)))
    low = (p - 1) // 2, (q - 1) // 2
    around = [(a, b - 1 - a) for a, b in zip(low, (p, q))]
    return {
        "flipped": by(image, kernel[::-1, ::-1]),
        "mean": by(image, kernel) / kernel.size,
        "from-the-end": by(image[rest[0] :, rest[1] :], kernel),
        "padded": by(np.pad(image, around), kernel),
    }


row.at_least_0(stride="a number of pixels")


@row.right  # A loop over the windows.
def _(image, kernel, stride):
    p, q = kernel.shape
    h = (image.shape[0] - p) // stride + 1
    w = (image.shape[1] - q) // stride + 1
    out = np.zeros((h, w))
    for i in range(h):
        for j in range(w):
            y, x = i * stride, j * stride
            out[i, j] = np.sum(image[y : y + p, x : x + q] * kernel)
    return out


@row.right  # Windows as a view.
def _(image, kernel, stride):
    windows = np.lib.stride_tricks.sliding_window_view(image, kernel.shape)
    return np.einsum("ijab,ab->ij", windows[::stride, ::stride], kernel)


@row.right  # All windows at stride 1, of which every few are kept.
def _(image, kernel, stride):
    p, q = kernel.shape
    rows = range(0, image.shape[0] - p + 1, stride)
    columns = range(0, image.shape[1] - q + 1, stride)
    return np.array(
        [[(image[i : i + p, j : j + q] * kernel).sum() for j in columns] for i in rows]
    )


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield size * rng.numbers(-1, 1, 9, 8), rng.numbers(-1, 1, 3, 2), 2
    yield rng.numbers(0, 1, 30, 28), 0.004 * rng.numbers(0, 1, 9, 9), 8

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
row.cases(
    a_square_kernel=lambda image, kernel, stride: len(set(kernel.shape)) == 1,
    a_kernel_that_is_not_square=lambda image, kernel, stride: (
        len(set(kernel.shape)) == 2
    ),
)


def correlated(image, kernel, stride):
    """Return the cross-correlation, which is empty where no window fits."""
    p, q = kernel.shape
    out = np.zeros([(a - b) // stride + 1 for a, b in zip(image.shape, (p, q))])
    for i, j in np.ndindex(out.shape):
        y, x = i * stride, j * stride
        out[i, j] = np.sum(image[y : y + p, x : x + q] * kernel)
    return out


def apart(image, kernel, m, n):
    """Return the sums of m x n windows that are as far apart as the kernel is large."""
    p, q = kernel.shape
    wide = np.pad(image, ((0, m * p), (0, n * q)))[: m * p, : n * q]
    return np.einsum("iajb,ab->ij", wide.reshape(m, p, n, q), kernel)


@row.wrongs
def _(image, kernel, stride):
    """flipped: your code flips the kernel along both axes, as a mathematical
      convolution does. Use the kernel without a flip, because `conv2d` computes the
      cross-correlation
    mean: your code divides each output by the number of entries of the kernel. Return
      the sum of the products without this division
    by-the-kernels-sum: your code divides each output by the sum of the kernel's
      entries. Return the sum of the products without this division
    transposed: your code transposes the kernel. Multiply entry [a, b] of the kernel by
      pixel [a, b] of the window
    output-transposed: your output is transposed. Output [i, j] should belong to the
      window that begins at pixel [i * stride, j * stride]
    """
    right = correlated(image, kernel, stride)
    return {
        "flipped": correlated(image, kernel[::-1, ::-1], stride),
        "mean": right / kernel.size,
        "by-the-kernels-sum": right / kernel.sum(),
        "transposed": lambda: correlated(image, kernel.T, stride),
        "output-transposed": right.T,
    }


@row.wrongs
def _(image, kernel, stride):
    """from-the-end: your code aligns the last window with the end of the image. Align
      the first window with pixel [0, 0], so that any unused pixels are at the end
    padded: your code pads the image with zeros, so it includes windows that extend
      beyond the image. Return one output for each window that lies inside the image
    padded 2: your code adds a border of zeros around the image, so it includes windows
      that extend beyond the image. Return one output for each window that lies inside
      the image
    across-the-edge: your code includes windows that begin inside the image and extend
      beyond its last row or column. Return one output for each window that lies inside
      the image
    one-less: your code omits the last row and the last column of windows. Add 1 to the
      number of strides that fit, because the first window needs no stride
    counted-before-the-division: your code adds 1 before it divides by the stride, so
      some windows can be missing. Add 1 after the division instead, because the first
      window needs no stride
    without-the-last: your code omits windows that end at the last row or column of the
      image. These windows lie inside the image, so include them
    """
    right = correlated(image, kernel, stride)
    sizes = list(zip(image.shape, kernel.shape))
    rest = [(a - b) % stride for a, b in sizes]
    around = [((b - 1) // 2, b // 2) for _, b in sizes]
    border = [(b // 2, b // 2) for _, b in sizes]
    beyond = [(0, (b - a) % stride) for a, b in sizes]
    before = [(a - b + 1) // stride for a, b in sizes]
    early = [-(-(a - b) // stride) for a, b in sizes]
    return {
        "from-the-end": correlated(image[rest[0] :, rest[1] :], kernel, stride),
        "padded": correlated(np.pad(image, around), kernel, stride),
        "padded 2": correlated(np.pad(image, border), kernel, stride),
        "across-the-edge": correlated(np.pad(image, beyond), kernel, stride),
        "one-less": right[:-1, :-1],
        "counted-before-the-division": right[: before[0], : before[1]],
        "without-the-last": right[: early[0], : early[1]],
    }


@row.wrongs
def _(image, kernel, stride):
    """stride-ignored: your code ignores the stride. Use only the windows whose first
      row and column are multiples of the stride
    at-i-j: your code begins the window of output [i, j] at pixel [i, j]. The window
      should begin at pixel [i * stride, j * stride]
    stride-along-y-only: your code applies the stride to the rows of the image, but not
      to its columns. Move the window by the stride along both axes
    stride-along-x-only: your code applies the stride to the columns of the image, but
      not to its rows. Move the window by the stride along both axes
    apart: your code moves the window by the size of the kernel. Move the window by the
      stride instead, so that windows can overlap
    sampled-first: your code subsamples the image by the stride before it applies the
      kernel. Apply the kernel to adjacent pixels, and use the stride only as the
      distance between windows
    """
    m, n = correlated(image, kernel, stride).shape
    each = correlated(image, kernel, 1)
    return {
        "stride-ignored": each,
        "at-i-j": each[:m, :n],
        "stride-along-y-only": each[::stride],
        "stride-along-x-only": each[:, ::stride],
        "apart": apart(image, kernel, m, n),
        "sampled-first": lambda: correlated(image[::stride, ::stride], kernel, 1),
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

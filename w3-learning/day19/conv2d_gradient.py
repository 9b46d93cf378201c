"""19.4 `conv2d_gradient(image, kernel, stride, d)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .images import pairs

row = Row((
    Matrix((None, None), called="the gradient with respect to the kernel"),
    Matrix((None, None), called="the gradient with respect to the image"),
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
row.cases(
    a_stride_of_1=lambda image, kernel, stride, d: stride == 1,
    a_larger_stride=lambda image, kernel, stride, d: stride > 1,
)


def windows(image, kernel, stride):
    """Return the windows of an image, (i, j, p, q)."""
    view = np.lib.stride_tricks.sliding_window_view(image, kernel.shape)
    return view[::stride, ::stride]


def of_image(image, kernel, stride, d, added=True):
    """Return the gradient of the image; added=False writes over what was there.

    The kernel is (p, q), or another one for each window, (m, n, p, q).
    """
    total = np.zeros(image.shape)
    p, q = kernel.shape[-2:]
    each = np.broadcast_to(kernel, (*d.shape, p, q))
    for (i, j), one in np.ndenumerate(d):
        at = np.s_[i * stride : i * stride + p, j * stride : j * stride + q]
        total[at] = one * each[i, j] + (total[at] if added else 0)
    return total


@row.wrongs
def _(image, kernel, stride, d):
    """kernel-flipped: your code flips the gradient with respect to the kernel along
      both axes. Entry [a, b] of this gradient should be the sum over all windows of d
      times pixel [a, b] of the window
    image-by-flipped: your gradient with respect to the image would be correct for the
      kernel flipped along both axes. Flip the kernel only if your code correlates the
      padded d with the kernel
    overwritten: your code overwrites the gradient with respect to the image where
      windows overlap. Add the contributions of all windows that contain a pixel instead
    averaged: your code averages the contributions to a pixel that lies in several
      windows. Add these contributions instead, because the output of each of these
      windows depends on the pixel
    divided: your code divides both gradients by the number of outputs. Omit this
      division, because d is already the gradient of the loss with respect to the output
    order: your function returns the two gradients in the wrong order. Return the
      gradient with respect to the kernel first
    last-window: your gradient with respect to the kernel contains only the contribution
      of the last window. Add the contributions of all windows
    """
    seen = windows(image, kernel, stride)
    of_kernel = np.einsum("ijab,ij->ab", seen, d)
    right = of_image(image, kernel, stride, d)
    counts = of_image(image, np.ones(kernel.shape), stride, np.ones(d.shape))
    return {
        "kernel-flipped": (of_kernel[::-1, ::-1], right),
        "image-by-flipped": (
            of_kernel,
            of_image(image, kernel[::-1, ::-1], stride, d),
        ),
        "overwritten": (of_kernel, of_image(image, kernel, stride, d, added=False)),
        "averaged": (of_kernel, right / np.maximum(counts, 1)),
        "divided": (of_kernel / d.size, right / d.size),
        "order": (right, of_kernel),
        "last-window": (d[-1, -1] * seen[-1, -1], right),
    }


@row.wrongs
def _(image, kernel, stride, d):
    """stride-only-for-image: your code applies the stride to the gradient with respect
      to the image, but not to the gradient with respect to the kernel. Output [i, j]
      uses the window that begins at pixel [i * stride, j * stride]
    stride-only-for-kernel: your code applies the stride to the gradient with respect to
      the kernel, but not to the gradient with respect to the image. Output [i, j] uses
      the window that begins at pixel [i * stride, j * stride]
    stride-forgotten: your code ignores the stride. Output [i, j] uses the window that
      begins at pixel [i * stride, j * stride]
    windows-for-image: your code adds d times the windows of the image to the gradient
      with respect to the image. Add d times the kernel instead, because the derivative
      of an output with respect to a pixel is an entry of the kernel
    kernel-for-kernel: your code adds d times the kernel to the gradient with respect to
      the kernel. Add d times the window instead, because the derivative of an output
      with respect to an entry of the kernel is the corresponding pixel in the window
    """
    seen = windows(image, kernel, stride)
    of_kernel = np.einsum("ijab,ij->ab", seen, d)
    right = of_image(image, kernel, stride, d)
    beside = windows(image, kernel, 1)[: len(d), : d.shape[1]]
    by_beside = np.einsum("ijab,ij->ab", beside, d), of_image(image, kernel, 1, d)
    return {
        "stride-only-for-image": (by_beside[0], right),
        "stride-only-for-kernel": (of_kernel, by_beside[1]),
        "stride-forgotten": by_beside,
        "windows-for-image": (of_kernel, of_image(image, seen, stride, d)),
        "kernel-for-kernel": (d.sum() * kernel, right),
    }


row.at_least_0(stride="a number of pixels")


@row.right  # Window by window.
def _(image, kernel, stride, d):
    p, q = kernel.shape
    of_kernel, of_image = np.zeros((p, q)), np.zeros(image.shape)
    for i in range(d.shape[0]):
        for j in range(d.shape[1]):
            y, x = i * stride, j * stride
            of_kernel += d[i, j] * image[y : y + p, x : x + q]
            of_image[y : y + p, x : x + q] += d[i, j] * kernel
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

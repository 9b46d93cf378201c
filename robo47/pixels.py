"""Images as observations: sampling and blur, convolution, spatial softmax, symmetry.

An image is an array (h, w) of pixel values. The first index goes along y and the second
along x: pixel [i, j] is at (xs[j], ys[i]). Conventions:

- `xs` (w,) and `ys` (h,) are the coordinates of the pixels in the plane, metres.
- Several images of one size, the channels, are an array (c, h, w).
- Complex numbers pass through `conv2d` and `spatial_softmax`, so that their gradients
  can be compared with the complex step.
- Metres, float64.

Sources: Finn and others, "Deep spatial autoencoders for visuomotor learning" (2016),
the spatial softmax; LeCun and others, "Backpropagation applied to handwritten zip code
recognition" (1989); Zhang, "Making convolutional networks shift-invariant again"
(2019), blur before subsampling.
"""

from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array

CELL = 0.1  # m between two pixels of Day 19's camera
SIDE = 12  # pixels of each of its rows and columns


def height_map(
    centres: ArrayLike, radii: ArrayLike, xs: ArrayLike, ys: ArrayLike
) -> Array:
    """Return the height of the highest sphere above each pixel of an image.

    The centres of all spheres are in the plane of height 0. A vertical ray at the
    distance d from a centre hits the sphere at the height sqrt(r^2 - d^2).

    Args:
        centres: (k, 2), metres.
        radii: (k,), metres.
        xs, ys: coordinates of the pixels, (w,) and (h,), metres.

    Returns:
        (h, w), metres; 0 where no sphere is hit.

    Raises:
        ValueError: a wrong shape, a number that is not finite, or a negative radius.
    """
    radii = checks.not_negative(checks.array(radii, "radii", ("k",)), "radii")
    centres = checks.array(centres, "centres", (len(radii), 2))
    xs = checks.array(xs, "xs", ("w",))
    ys = checks.array(ys, "ys", ("h",))
    dx = xs - centres[:, 0, None, None]
    dy = ys[:, None] - centres[:, 1, None, None]
    squared = radii[:, None, None] ** 2 - dx**2 - dy**2
    return np.sqrt(np.maximum(squared, 0.0).max(axis=0))


def gaussian_kernel(sigma: float, half: int) -> Array:
    """Return a square kernel whose entries follow a Gaussian and sum to 1.

    Args:
        sigma: standard deviation, pixels.
        half: number of pixels on each side of the middle.

    Returns:
        (2 half + 1, 2 half + 1).

    Raises:
        ValueError: sigma not above 0, or a negative half.
    """
    sigma = float(checks.positive(sigma, "sigma"))
    if half < 0:
        raise ValueError(f"half is {half}; it must not be below 0")
    row = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    row /= row.sum()
    return np.outer(row, row)


def conv2d(image: ArrayLike, kernel: ArrayLike, stride: int) -> Array:
    """Return the cross-correlation of an image with a kernel, without padding.

    Networks call this operation a convolution. Output [i, j] is the sum of the window
    image[i stride : i stride + p, j stride : j stride + q] times the kernel.

    Args:
        image: (h, w).
        kernel: (p, q), not larger than the image; it is not flipped.
        stride: step of the window along both axes, pixels.

    Returns:
        ((h - p) // stride + 1, (w - q) // stride + 1).

    Raises:
        ValueError: a wrong shape, a kernel larger than the image, or a stride below 1.
    """
    windows, kernel = _windows(image, kernel, stride)
    return np.einsum("ijpq,pq->ij", windows, kernel)


def conv2d_gradient(
    image: ArrayLike, kernel: ArrayLike, stride: int, d: ArrayLike
) -> tuple[Array, Array]:
    """Return the gradients of a loss with respect to a kernel and an image.

    Args:
        image, kernel, stride: of `conv2d`.
        d: gradient of the loss with respect to the output of `conv2d`, in its shape.

    Returns:
        The gradients with respect to the kernel and to the image, in their shapes.

    Raises:
        ValueError: as for `conv2d`, or a wrong shape of d.
    """
    windows, kernel = _windows(image, kernel, stride)
    d = _image(d, "d")
    if d.shape != windows.shape[:2]:
        raise ValueError(f"d has shape {d.shape}; expected {windows.shape[:2]}")
    of_image = np.zeros(np.shape(image), dtype=np.result_type(d, kernel))
    rows, columns = (stride * (size - 1) + 1 for size in d.shape)
    for (a, b), weight in np.ndenumerate(kernel):
        of_image[a : a + rows : stride, b : b + columns : stride] += weight * d
    return np.einsum("ijpq,ij->pq", windows, d), of_image


def spatial_softmax(
    maps: ArrayLike, xs: ArrayLike, ys: ArrayLike, temperature: float
) -> Array:
    """Return the expected position in each map, weighted by the softmax over the map.

    Args:
        maps: (c, h, w); an entry of -inf has the weight 0.
        xs, ys: coordinates of the pixels, (w,) and (h,).
        temperature: divides the maps; a small one approaches the largest entry.

    Returns:
        (x, y) of each map, (c, 2), in the unit of xs and ys (soft arg-max).

    Raises:
        ValueError: a wrong shape, a temperature not above 0, or a map of only -inf.
    """
    p, xs, ys = _weights(maps, xs, ys, temperature)
    return np.stack([p.sum(axis=1) @ xs, p.sum(axis=2) @ ys], axis=1)


def spatial_softmax_gradient(
    maps: ArrayLike, xs: ArrayLike, ys: ArrayLike, temperature: float, d: ArrayLike
) -> Array:
    """Return the gradient of a loss with respect to the maps of `spatial_softmax`.

    Args:
        maps, xs, ys, temperature: of `spatial_softmax`.
        d: gradient of the loss with respect to its result, (c, 2).

    Returns:
        (c, h, w).

    Raises:
        ValueError: as for `spatial_softmax`, or a wrong shape of d.
    """
    p, xs, ys = _weights(maps, xs, ys, temperature)
    d = np.asarray(d, dtype=np.float64)
    if d.shape != (len(p), 2):
        raise ValueError(f"d has shape {d.shape}; expected {(len(p), 2)}")
    value = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]
    mean = (p * value).sum(axis=(1, 2), keepdims=True)
    gradient: Array = p * (value - mean) / temperature
    return gradient


def centroid_error(spacing: ArrayLike, sigma: ArrayLike) -> Array:
    """Return the largest error of the centroid of a sampled Gaussian.

    A spot of light is blurred to a Gaussian and then sampled by pixels. By Poisson's
    summation formula the centroid of the samples is off by at most
    4 pi sigma^2 / spacing exp(-2 (pi sigma / spacing)^2), where terms of higher
    frequency are neglected. They matter below a sigma of 0.3 spacings.

    Args:
        spacing: distance between two pixels.
        sigma: standard deviation of the Gaussian, in the same unit.

    Returns:
        The error, in the same unit; arguments broadcast.

    Raises:
        ValueError: an argument that is not above 0.
    """
    spacing = checks.positive(spacing, "spacing")
    sigma = checks.positive(sigma, "sigma")
    decay = np.exp(-2.0 * (np.pi * sigma / spacing) ** 2)
    error: Array = 4.0 * np.pi * sigma**2 / spacing * decay
    return error


def quarter_turn(images: ArrayLike, action: ArrayLike, k: int) -> tuple[Array, Array]:
    """Return images and an action after k rotations of the scene by 90 degrees.

    Each rotation maps the point (x, y) to (-y, x). The origin is in the middle of the
    images.

    Args:
        images: (c, h, h).
        action: a vector in the plane, (2,).
        k: number of quarter turns from x towards y; it may be negative.

    Returns:
        (images, action), new arrays of the same shapes.

    Raises:
        ValueError: a wrong shape, or images that are not square.
    """
    images = np.asarray(images, dtype=np.float64)
    if images.ndim != 3 or images.shape[1] != images.shape[2]:
        raise ValueError(f"images has shape {images.shape}; expected (c, h, h)")
    x, y = checks.array(action, "action", (2,))
    turned = ((x, y), (-y, x), (-x, -y), (y, -x))[k % 4]
    return np.rot90(images, -k, axes=(1, 2)).copy(), np.array(turned)


def pixel_grid(
    cell: float = CELL, side: int = SIDE, finer: int = 1, margin: int = 0
) -> Array:
    """Return the coordinates of a row of pixels whose middle is the origin, metres.

    Args:
        cell: distance between two pixels, metres.
        side: number of pixels.
        finer: with a number above 1, the grid has that many points per pixel. Each
            pixel is a point of this finer grid.
        margin: number of further points of the finer grid at each end.
    """
    n = finer * (side - 1) + 1 + 2 * margin
    return cell / finer * (np.arange(n) - (n - 1) / 2)


def spot_images(points: ArrayLike, xs: ArrayLike, ys: ArrayLike, sigma: float) -> Array:
    """Return the images of points of light that are blurred to a Gaussian.

    Args:
        points: (..., 2), metres.
        xs, ys: coordinates of the pixels, (w,) and (h,), metres.
        sigma: standard deviation of the Gaussian, metres.

    Returns:
        (..., h, w): exp(-d^2 / (2 sigma^2)) at the distance d from the point.

    Raises:
        ValueError: a wrong shape, or sigma not above 0.
    """
    points = checks.array(points, "points", (2,))
    sigma = float(checks.positive(sigma, "sigma"))
    along_x, along_y = (
        np.exp(
            -0.5
            * ((checks.array(axis, name, ("n",)) - points[..., i, None]) / sigma) ** 2
        )
        for i, (axis, name) in enumerate(((xs, "xs"), (ys, "ys")))
    )
    return along_y[..., :, None] * along_x[..., None, :]


def _windows(image: ArrayLike, kernel: ArrayLike, stride: int) -> tuple[Array, Array]:
    """Return the windows of an image, (i, j, p, q), and the kernel, after checks."""
    image = _image(image, "image")
    kernel = _image(kernel, "kernel")
    if stride < 1:
        raise ValueError(f"stride is {stride}; it must be at least 1")
    if kernel.size == 0 or any(np.array(kernel.shape) > image.shape):
        raise ValueError(
            f"kernel has shape {kernel.shape} and image {image.shape}; "
            "expected a kernel that fits into the image"
        )
    windows: Any = sliding_window_view(image, kernel.shape)
    return windows[::stride, ::stride], kernel


def _image(value: ArrayLike, name: str) -> Array:
    """Return a matrix of real or complex numbers."""
    array: Any = np.asarray(value)
    if array.ndim != 2:
        raise ValueError(f"{name} has shape {array.shape}; expected (rows, columns)")
    return array if array.dtype.kind == "c" else array.astype(np.float64)  # type: ignore[no-any-return]


def _weights(
    maps: ArrayLike, xs: ArrayLike, ys: ArrayLike, temperature: float
) -> tuple[Array, Array, Array]:
    """Return the softmax over each map, (c, h, w), and the pixels' coordinates."""
    maps = np.asarray(maps)
    xs = checks.array(xs, "xs", ("w",))
    ys = checks.array(ys, "ys", ("h",))
    if maps.ndim != 3 or maps.shape[1:] != (len(ys), len(xs)):
        raise ValueError(
            f"maps has shape {maps.shape}, ys {ys.shape} and xs {xs.shape}; "
            "expected (c, h, w), (h,) and (w,)"
        )
    checks.positive(temperature, "temperature")
    most = maps.real.max(axis=(1, 2), keepdims=True)
    if np.isneginf(most).any():
        raise ValueError("a map has only entries of -inf, so no pixel has a weight")
    p = np.exp((maps - most) / temperature)
    return p / p.sum(axis=(1, 2), keepdims=True), xs, ys

"""10.1 `camera_matrix(fovy, width, height)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((3, 3), scale=100.0))


@row.inputs
def _(rng):
    drawn = zip(
        rng.numbers(0.3, 2.5, 8),
        rng.integers(300, 700, 8),
        rng.integers(100, 280, 8),
        strict=True,
    )
    return [(np.pi / 2, 200, 100), (0.8, 120, 480), *drawn]


def matrix(fx, fy, cx, cy):
    """Return K with these parameters."""
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])


@row.wrongs(hidden={"whole-division": "the lab's images have even sides"})
def _(fovy, width, height):
    """width-for-height: your code computes f from the width. Use the height instead,
      because fovy is the vertical field of view
    two-focal-lengths: your code computes fx from the width. Compute both fx and fy from
      the height, because the pixels are square
    sine-for-tangent: your code computes f with the sine of half the field of view. Use
      the tangent instead, because half the height is the opposite side and f the
      adjacent side of this angle
    middle-of-a-pixel: your code uses ((width - 1) / 2, (height - 1) / 2) as the
      principal point. Use (width / 2, height / 2) instead, because in this task (0, 0)
      is the corner of the image and not the centre of the first pixel
    centre-at-0: your code uses (0, 0) as the principal point. Use (width / 2, height /
      2) instead, which is the centre of the image
    centre-whole: your code uses (width, height) as the principal point. Use (width / 2,
      height / 2) instead, which is the centre of the image
    y-up: your code returns a negative fy. The focal length fy should be positive,
      because v and y both point down
    whole-division: your code rounds down half the width and half the height, as //
      does. Do not round these values, because the centre of an image that is 353 pixels
      wide is at 176.5
    """
    f = height / 2 / np.tan(fovy / 2)
    fw = width / 2 / np.tan(fovy / 2)
    cx = width / 2
    cy = height / 2
    return {
        "width-for-height": matrix(fw, fw, cx, cy),
        "two-focal-lengths": matrix(fw, f, cx, cy),
        "sine-for-tangent": matrix(*[height / 2 / np.sin(fovy / 2)] * 2, cx, cy),
        "middle-of-a-pixel": matrix(f, f, (width - 1) / 2, (height - 1) / 2),
        "centre-at-0": matrix(f, f, 0, 0),
        "centre-whole": matrix(f, f, width, height),
        "y-up": matrix(f, -f, cx, cy),
        "whole-division": matrix(
            *[height // 2 / np.tan(fovy / 2)] * 2, width // 2, height // 2
        ),
    }


row.at_least_0(
    fovy="a field of view",
    width="a number of pixels",
    height="a number of pixels",
    answer="f and the principal point are",
)


@row.right  # By the cotangent, in one product.
def _(fovy, width, height):
    f = np.cos(fovy / 2) / np.sin(fovy / 2)
    unit = np.array([[f, 0, width / height], [0, f, 1], [0, 0, 2 / height]])
    return height / 2 * unit

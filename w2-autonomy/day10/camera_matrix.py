"""10.1 `camera_matrix(fovy, width, height)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from labkit.judge.argument_mistakes import RADIANS_TWICE

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
    """Return K with these."""
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])


@row.wrongs(hidden={"whole-division": "the lab's images have even sides"})
def _(fovy, width, height):
    """whole-angle: the tangent is that of the whole angle; half of the picture is seen
      under half of the angle => with tan(fovy)
    whole-height: f is the whole height over the tangent; half the height belongs to
      half the angle => with twice that f
    width-for-height: f comes from the width; fovy is the angle from top to bottom =>
      with width / 2 in f
    two-focal-lengths: fx comes from the width; pixels are square, so one f, from the
      height, serves both axes => with width / 2 in fx
    focal-length-inverted: it is tan(fovy / 2) over half the height, upside down
    tangent-multiplied: half the height is multiplied by the tangent; f is divided by
      it => with height / 2 tan(fovy / 2)
    sine-for-tangent: f is half the height over the sine; the half height is opposite
      the angle and f beside it => with sin(fovy / 2)
    degrees: fovy is converted to degrees; the tangent takes radians, as it comes
    middle-of-a-pixel: the centre is (width - 1) / 2, as OpenCV's is, whose (0, 0) is
      the middle of the first pixel; here it is the corner => with (width - 1) / 2
    centre-swapped: the centre's two numbers are swapped: u goes with the width
    centre-at-0: the centre is 0; a point straight ahead is seen in the middle
    centre-whole: the centre is the width and the height; the middle is half of both
    y-up: the second f is negative; v grows downwards, and so does y => with -f
    whole-division: // cuts off the half of an odd number of pixels: the middle of 353
      pixels is at 176.5 => with //
    last-entry-0: the last entry is 0; K (x, y, z) has to keep z for the division
    centre-in-the-last-row: the centre stands in the last row; it is a column
    """
    f = height / 2 / np.tan(fovy / 2)
    fw = width / 2 / np.tan(fovy / 2)
    cx = width / 2
    cy = height / 2
    right = matrix(f, f, cx, cy)
    return {
        "whole-angle": matrix(*[height / 2 / np.tan(fovy)] * 2, cx, cy),
        "whole-height": matrix(2 * f, 2 * f, cx, cy),
        "width-for-height": matrix(fw, fw, cx, cy),
        "two-focal-lengths": matrix(fw, f, cx, cy),
        "focal-length-inverted": matrix(1 / f, 1 / f, cx, cy),
        "tangent-multiplied": matrix(*[height / 2 * np.tan(fovy / 2)] * 2, cx, cy),
        "sine-for-tangent": matrix(*[height / 2 / np.sin(fovy / 2)] * 2, cx, cy),
        "degrees": matrix(*[height / 2 / np.tan(np.rad2deg(fovy) / 2)] * 2, cx, cy),
        "middle-of-a-pixel": matrix(f, f, (width - 1) / 2, (height - 1) / 2),
        "centre-swapped": matrix(f, f, cy, cx),
        "centre-at-0": matrix(f, f, 0, 0),
        "centre-whole": matrix(f, f, width, height),
        "y-up": matrix(f, -f, cx, cy),
        "whole-division": matrix(
            *[height // 2 / np.tan(fovy / 2)] * 2, width // 2, height // 2
        ),
        "last-entry-0": right - np.diag([0, 0, 1.0]),
        "centre-in-the-last-row": right.T,
    }


row.of_argument("fovy", RADIANS_TWICE)
row.at_least_0(
    fovy="an angle of view",
    width="a number of pixels",
    height="a number of pixels",
    answer="f and the centre are",
)


@row.right  # By the cotangent, in one product.
def _(fovy, width, height):
    f = np.cos(fovy / 2) / np.sin(fovy / 2)
    unit = np.array([[f, 0, width / height], [0, f, 1], [0, 0, 2 / height]])
    return height / 2 * unit

"""10.4 `projection_jacobian(K, p_cam)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.kinds import Kind
from robo47.screws import skew

from .seen import HALF, K, before, cameras

SIZES = (8, 8, 5, 5, 1, 1)
row = Row(Kind((None, 2, 6), unit="px", scale=100.0))


@row.inputs
def _(rng):
    drawn = [(k, before(rng, n)) for k, n in zip(cameras(rng), SIZES, strict=True)]
    return [(K, np.array([[0.0, 0, 2]])), *drawn]


def by_point(K, p):
    """Return d(pixel)/dp, (n, 2, 3)."""
    f = K[0, 0]
    x, y, z = p.T
    zero = 0 * x
    rows = f / z * np.array([[1 + zero, zero, -x / z], [zero, 1 + zero, -y / z]])
    return np.moveaxis(rows, 2, 0)


def by_twist(p, sign=-1.0):
    """Return dp/dxi, (n, 3, 6)."""
    return np.concatenate([sign * skew(p), np.tile(np.eye(3), (len(p), 1, 1))], axis=2)


@row.wrongs
def _(K, p_cam):
    """depth-column-forgotten: the third column of d(pixel)/dp is 0: a point that comes
      nearer moves outwards, by -f x / z^2 => without -x / z^2
    depth-column-sign: the third column of d(pixel)/dp has the wrong sign: the slope of
      x / z with z is -x / z^2 => with +x / z^2
    one-z-too-few: the third column of d(pixel)/dp is divided by z once; the slope of
      1 / z is -1 / z^2 => with -x / z
    f-forgotten: f is missing: these are slopes of x / z, in no unit
    not-divided: d(pixel)/dp is not divided by z
    halves-swapped: the columns are (v; omega); here omega comes first
    camera-moves: all signs are turned: these are the pixels of a camera that moves;
      here what is seen moves => the right one with the other sign
    rotation-sign: the rotation's columns have the wrong sign: omega x p is -[p] omega
      => with +[p]
    rotation-forgotten: the rotation's columns are 0; a turn about the camera's origin
      moves what is seen, too
    v-forgotten: the columns of v are 0; v moves every point
    rows-swapped: the rows of u and v are swapped
    y-up: the row of v has the wrong sign; y and v point down here
    """
    D = by_point(K, p_cam)
    flat = D * [1, 1, 0]
    z = p_cam[:, 2, None, None]
    right = D @ by_twist(p_cam)
    return {
        "depth-column-forgotten": flat @ by_twist(p_cam),
        "depth-column-sign": (2 * flat - D) @ by_twist(p_cam),
        "one-z-too-few": (flat + (D - flat) * z) @ by_twist(p_cam),
        "f-forgotten": right / K[0, 0],
        "not-divided": right * z,
        "halves-swapped": right[..., HALF],
        "camera-moves": -right,
        "rotation-sign": D @ by_twist(p_cam, 1.0),
        "rotation-forgotten": right * [0, 0, 0, 1, 1, 1],
        "v-forgotten": right * [1, 1, 1, 0, 0, 0],
        "rows-swapped": right[:, ::-1],
        "y-up": right * [[1], [-1]],
    }


row.at_least_0(K="f and the centre are")


@row.right  # Entry by entry, as in papers on visual servoing.
def _(K, p_cam):
    f = K[0, 0]
    found = []
    for X, Y, Z in p_cam:
        x = X / Z
        y = Y / Z
        found.append([
            [-f * x * y, f * (1 + x * x), -f * y, f / Z, 0, -f * x / Z],
            [-f * (1 + y * y), f * x * y, f * x, 0, f / Z, -f * y / Z],
        ])  # fmt: skip
    return np.array(found)

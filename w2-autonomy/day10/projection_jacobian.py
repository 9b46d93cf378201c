"""10.4 `projection_jacobian(K, p_cam)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row
from labkit.judge.kinds import Kind
from robo47.screws import skew

from .seen import HALF, OBLONG, K, before, cameras

SIZES = (8, 8, 5, 5, 1, 1)
row = Row(Kind((None, 2, 6), unit="px", scale=100.0))


@row.inputs
def _(rng):
    drawn = [(k, before(rng, n)) for k, n in zip(cameras(rng), SIZES, strict=True)]
    asked = [(K, np.array([[0.0, 0, 2]])), (OBLONG, np.array([[0.2, -0.1, 2]]))]
    return [*asked, *drawn]


row.spans(p_cam=(lambda p: 0.02 * p, lambda p: 50.0 * p))


def by_point(K, p):
    """Return d(pixel)/dp, (n, 2, 3)."""
    x, y, z = p.T
    zero = 0 * x
    rows = np.array([[1 + zero, zero, -x / z], [zero, 1 + zero, -y / z]]) / z
    return focal(K) * np.moveaxis(rows, 2, 0)


def focal(K):
    """Return fx and fy, one for each row, (2, 1)."""
    return np.array([[K[0, 0]], [K[1, 1]]])


def by_twist(p, sign=-1.0):
    """Return dp/dxi, (n, 3, 6)."""
    return np.concatenate([sign * skew(p), np.tile(np.eye(3), (len(p), 1, 1))], axis=2)


def slopes(
    K, p_cam, *, pixel=by_point, twist=by_twist, told=lambda J: J
):  # fmt: skip
    """Return the Jacobian with other parts."""
    return told(pixel(K, p_cam) @ twist(p_cam))


def third(change):
    """Return d(pixel)/dp with another third column: a factor, of z."""
    return lambda K, p: by_point(K, p) * np.dstack([
        np.ones((len(p), 1, 2)), np.reshape(change(p[:, 2]) + 0 * p[:, 2], (-1, 1, 1))
    ])  # fmt: skip


def depth(p, power):
    """Return z to a power, (n, 1, 1)."""
    return p[:, 2, None, None] ** power


def with_the_centre(K, p):
    """Return K[:2] times the slopes of (x / z, y / z, z)."""
    D = by_point(K, p) / focal(K)
    last = np.tile([0.0, 0.0, 1.0], (len(p), 1, 1))
    return K[:2] @ np.concatenate([D, last], axis=1)


def of_the_pixel(K, p):
    """Return d(pixel)/dp with u and v for x and y."""
    D = by_point(K, p)
    D[:, :, 2] = -focal(K).T * ((p @ K.T)[:, :2] / p[:, 2:]) / p[:, 2:] ** 2
    return D


def with_one_name(of, other):
    """Return d(pixel)/dp where both rows use the same coordinate."""

    def wrong(K, p):
        D = by_point(K, p)
        D[:, of, 2] = D[:, other, 2]
        return D

    return wrong


for slug, says, redone, other in (
    ("depth-column-forgotten", "the third column of d(pixel)/dp is 0: a point that "
     "comes nearer moves outwards, by -f x / z^2", "without -x / z^2",
     {"pixel": third(lambda z: 0.0)}),
    ("depth-column-sign", "the third column of d(pixel)/dp has the wrong sign: the "
     "slope of x / z with z is -x / z^2", "with +x / z^2",
     {"pixel": third(lambda z: -1.0)}),
    ("one-z-too-few", "the third column of d(pixel)/dp is divided by z once; the slope "
     "of 1 / z is -1 / z^2", "with -x / z", {"pixel": third(lambda z: z)}),
    ("two-z-too-few", "the third column of d(pixel)/dp is not divided by z; the slope "
     "of 1 / z is -1 / z^2", "with -x", {"pixel": third(lambda z: z * z)}),
    ("one-z-too-many", "the third column of d(pixel)/dp is divided by z three times; "
     "the slope of 1 / z is -1 / z^2", "with -x / z^3",
     {"pixel": third(lambda z: 1 / z)}),
    ("f-forgotten", "f is missing: these are slopes of x / z, in no unit", "without f",
     {"pixel": lambda K, p: by_point(K, p) / focal(K)}),
    ("fx-in-both-rows", "the row of v has fx; its focal length is fy, K[1, 1]",
     "with K[0, 0] twice", {"pixel": lambda K, p: by_point(
         K, p) / focal(K) * K[0, 0]}),
    ("fy-in-both-rows", "the row of u has fy; its focal length is fx, K[0, 0]",
     "with K[1, 1] twice", {"pixel": lambda K, p: by_point(
         K, p) / focal(K) * K[1, 1]}),
    ("not-divided", "d(pixel)/dp is not divided by z", "times z",
     {"pixel": lambda K, p: by_point(K, p) * depth(p, 1)}),
    ("divided-once-more", "all of d(pixel)/dp is divided by z once more; only its "
     "third column is", "divided by z",
     {"pixel": lambda K, p: by_point(K, p) / depth(p, 1)}),
    ("centre-in-the-slope", "the centre is in the third column; it is added to the "
     "pixel, so no slope has it", "with the centre in the third column",
     {"pixel": with_the_centre}),
    ("x-for-y", "the row of v has x in its third column; it is -y / z^2", "with x",
     {"pixel": with_one_name(1, 0)}),
    ("y-for-x", "the row of u has y in its third column; it is -x / z^2", "with y",
     {"pixel": with_one_name(0, 1)}),
    ("first-columns-not-divided", "d(pixel)/dp's first two columns are not divided "
     "by z; only the third is", "with f for f / z", {"pixel": lambda K, p: by_point(
         K, p) * np.where([True, True, False], depth(p, 1), 1.0)}),
    ("pixels-for-x-and-y", "the third column has the pixel's own u and v; it has "
     "x and y", "with -u / z", {"pixel": of_the_pixel}),
    ("v-of-y-sign", "the slope of v with y has the wrong sign; y and v both point down",
     "with -f / z there", {"pixel": lambda K, p: by_point(K, p)
                           * [[1, 1, 1], [1, -1, 1]]}),
    ("one-depth-sign", "the slope of u with z has the wrong sign: it is -f x / z^2",
     "with +x / z^2 in u", {"pixel": lambda K, p: by_point(K, p)
                            * [[1, 1, -1], [1, 1, 1]]}),
    ("one-depth-sign", "the slope of v with z has the wrong sign: it is -f y / z^2",
     "with +y / z^2 in v", {"pixel": lambda K, p: by_point(K, p)
                            * [[1, 1, 1], [1, 1, -1]]}),
    ("range-for-depth", "it is divided by the point's distance; a camera divides by z",
     "with the length of p", {"pixel": lambda K, p: by_point(
         K, np.column_stack([p[:, :2], np.linalg.norm(p, axis=1)]))}),
    ("halves-swapped", "the columns are (v; omega); here omega comes first",
     "[1, -[p]]", {"told": lambda J: J[..., HALF]}),
    ("rotation-sign", "the rotation's columns have the wrong sign: omega x p is -[p] "
     "omega", "with +[p]", {"twist": lambda p: by_twist(p, 1.0)}),
    ("rotation-forgotten", "the rotation's columns are 0; a turn about the camera's "
     "origin moves what is seen, too", "[0, 1]",
     {"twist": lambda p: by_twist(p) * [0, 0, 0, 1, 1, 1]}),
    ("v-forgotten", "the columns of v are 0; v moves every point", "[-[p], 0]",
     {"twist": lambda p: by_twist(p) * [1, 1, 1, 0, 0, 0]}),
    ("v-sign", "the columns of v have the wrong sign: what is seen moves with v",
     "[-[p], -1]", {"twist": lambda p: by_twist(p) * [1, 1, 1, -1, -1, -1]}),
    ("camera-moves", "all signs are turned: these are the pixels of a camera that "
     "moves; here what is seen moves", "the right one with the other sign",
     {"told": np.negative}),
    ("rows-swapped", "the rows of u and v are swapped", "(v, u)",
     {"told": lambda J: J[:, ::-1]}),
    ("y-up", "the row of v has the wrong sign; y and v point down here", "with -v",
     {"told": lambda J: J * [[1], [-1]]}),
):  # fmt: skip
    one = "the lab's camera has fx = fy" if "-in-both-rows" in slug else ""
    row.wrong(slug, says, redone, hidden=one)(partial(slopes, **other))


row.at_least_0(K="f and the centre are")


@row.right  # Entry by entry, as in papers on visual servoing.
def _(K, p_cam):
    fx, fy = K[0, 0], K[1, 1]
    found = []
    for X, Y, Z in p_cam:
        x = X / Z
        y = Y / Z
        found.append([
            [-fx * x * y, fx * (1 + x * x), -fx * y, fx / Z, 0, -fx * x / Z],
            [-fy * (1 + y * y), fy * x * y, fy * x, 0, fy / Z, -fy * y / Z],
        ])  # fmt: skip
    return np.array(found)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # 0.2 m at least in the slopes.
def _(K, p_cam):
    p = p_cam.copy()
    p[:, 2] = np.maximum(p[:, 2], 0.2)
    return by_point(K, p) @ by_twist(p_cam)

"""10.4 `projection_jacobian(K, p_cam)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row
from labkit.judge.kinds import Kind
from robo47.screws import skew

from .seen import HALF, OBLONG, K, before, cameras

SIZES = (8, 8, 5, 5, 1, 1)
ONE_FOCAL_LENGTH = ("fx-in-both-rows", "fx-in-both-rows 2", "fy-in-both-rows")
row = Row(
    Kind((None, 2, 6), unit="px", scale=100.0),
    conditions=[("both focal lengths are equal", lambda K, p_cam: K[0, 0] == K[1, 1])],
)


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


def jacobian(
    K, p_cam, *, pixel=by_point, twist=by_twist, told=lambda J: J
):  # fmt: skip
    """Return the Jacobian with other derivatives or another output."""
    return told(pixel(K, p_cam) @ twist(p_cam))


def third(change):
    """Return d(pixel)/dp with the third column times a factor of z."""
    return lambda K, p: by_point(K, p) * np.dstack([
        np.ones((len(p), 1, 2)), np.reshape(change(p[:, 2]) + 0 * p[:, 2], (-1, 1, 1))
    ])  # fmt: skip


def depth(p, power):
    """Return z to a power, (n, 1, 1)."""
    return p[:, 2, None, None] ** power


def with_the_centre(K, p):
    """Return K[:2] times the derivatives of (x / z, y / z, z)."""
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


for slug, says, other in (
    ("depth-column-forgotten",
     "your code returns 0 for the derivatives with respect to z. These derivatives "
     "should be -fx x / z^2 and -fy y / z^2, because a nearer point projects farther "
     "from the principal point",
                               {"pixel": third(lambda z: 0.0)}),
    ("depth-column-sign",
     "your code returns the derivatives with respect to z with the wrong sign. The "
     "derivative of x / z with respect to z is -x / z^2",
                          {"pixel": third(lambda z: -1.0)}),
    ("power-of-z",
     "your derivatives with respect to z have the wrong power of z. The derivative of "
     "x / z with respect to z is -x / z^2",
     {"pixel": third(lambda z: z)}),
    ("power-of-z",
     "your derivatives with respect to z have the wrong power of z. The derivative of "
     "x / z with respect to z is -x / z^2",
                   {"pixel": third(lambda z: z * z)}),
    ("power-of-z",
     "your derivatives with respect to z have the wrong power of z. The derivative of "
     "x / z with respect to z is -x / z^2",
                   {"pixel": third(lambda z: 1 / z)}),
    ("f-forgotten",
     "your code omits the focal lengths. Multiply the row for u by fx and the row for "
     "v by fy",
     {"pixel": lambda K, p: by_point(K, p) / focal(K)}),
    ("centre-in-the-slope",
     "your code includes the principal point in the derivatives with respect to z. "
     "Omit the principal point, because it is constant and its derivative is 0",
     {"pixel": with_the_centre}),
    ("x-for-y",
     "your code uses x instead of y in the row for v. The derivative with respect to z "
     "should be -fy y / z^2 in this row", {"pixel": with_one_name(1, 0)}),
    ("y-for-x",
     "your code uses y instead of x in the row for u. The derivative with respect to z "
     "should be -fx x / z^2 in this row", {"pixel": with_one_name(0, 1)}),
    ("first-columns-not-divided", "your code does not divide the derivatives with "
                                  "respect to x and y by z. These derivatives should "
                                  "be fx / z and fy / z",
     {"pixel": lambda K, p: by_point(
         K, p) * np.where([True, True, False], depth(p, 1), 1.0)}),
    ("pixels-for-x-and-y",
     "your code uses the pixel coordinates (u, v) in the derivatives with respect to "
     "z. Use x and y in the camera frame instead", {"pixel": of_the_pixel}),
    ("range-for-depth",
     "your code uses the distance of the point from the camera in the derivatives. Use "
     "the depth z instead",
     {"pixel": lambda K, p: by_point(
         K, np.column_stack([p[:, :2], np.linalg.norm(p, axis=1)]))}),
    ("halves-swapped",
     "your code returns the columns in the order (v; omega). The order should be "
     "(omega; v)",
     {"told": lambda J: J[..., HALF]}),
    ("rotation-sign",
     "your code returns the columns for omega with the wrong sign. Use -[p] in these "
     "columns, because the velocity omega x p is equal to -[p] omega",
     {"twist": lambda p: by_twist(p, 1.0)}),
    ("camera-moves",
     "your Jacobian has the opposite sign, as for a moving camera or for the error "
     "(measured minus projected). Return the derivative of the projected pixel for "
     "moving points, because in this task the camera does not move",
     {"told": np.negative}),
    ("y-up",
     "your code returns the row for v with the wrong sign. Keep the sign of y, because "
     "y and v both point down",
     {"told": lambda J: J * [[1], [-1]]}),
):  # fmt: skip
    row.wrong(slug, says)(partial(jacobian, **other))


@row.wrongs(hidden=dict.fromkeys(ONE_FOCAL_LENGTH, "the lab's camera has fx = fy"))
def _(K, p_cam):
    """fx-in-both-rows: your code uses fx in the row for v. Use fy instead, which is
      K[1, 1]
    fx-in-both-rows 2: in the row for v, your code uses fx in the columns for omega. Use
      fy there too, as in the other columns. It is K[1, 1]
    fy-in-both-rows: your code uses fy in the row for u. Use fx instead, which is K[0,
      0]
    coordinates-not-divided: your code uses x and y in metres in the formula for
      normalised coordinates. Divide x and y by z first
    """
    J = jacobian(K, p_cam)
    swap = [[1.0], [K[0, 0] / K[1, 1]]]
    at_1 = np.column_stack([p_cam[:, :2], np.ones(len(p_cam))])
    flat = jacobian(K, at_1)
    flat[..., 3:5] = J[..., 3:5]
    flat[..., 5] /= p_cam[:, 2:]
    mixed = J.copy()
    mixed[..., :3] *= swap
    return {
        "fx-in-both-rows": J * swap,
        "fx-in-both-rows 2": mixed,
        "fy-in-both-rows": J * [[K[1, 1] / K[0, 0]], [1.0]],
        "coordinates-not-divided": flat,
    }


row.at_least_0(K="f and the principal point are")


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
)  # The derivatives use a depth of at least 0.2 m.
def _(K, p_cam):
    p = p_cam.copy()
    p[:, 2] = np.maximum(p[:, 2], 0.2)
    return by_point(K, p) @ by_twist(p_cam)

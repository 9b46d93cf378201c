"""10.2 `project(K, T_cam_world, points)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pixels, Row

from .seen import OBLONG, K, one_focal_length, views

row = Row(Pixels())


@row.inputs
def _(rng):
    first = (K, np.eye(4), np.array([[1.0, 0, 2]]))
    oblong = (OBLONG, np.eye(4), np.array([[0.2, -0.1, 2]]))
    return [first, oblong, *views(rng), *views(rng, 2, 3)]


@row.spans
def _(rng):
    yield K, np.eye(4), np.array([[0.001, -0.002, 0.02], [30.0, -20, 200]])


def seen(
    K, T_cam_world, points, *, moved=lambda R, t, x: x @ R.T + t,
    times=lambda K, p: p @ K.T, divided=lambda h, p: h[:, :2] / h[:, 2:],
    told=lambda pixels: pixels,
):  # fmt: skip
    """Return the pixels with another transform, product, division or output."""
    p = moved(T_cam_world[:3, :3], T_cam_world[:3, 3], points)
    return told(divided(times(K, p), p))


def length(p):
    """Return the distance of each point from the camera, (n, 1)."""
    return np.linalg.norm(p, axis=1)[:, None]


def upright(K, p, f=1.0, centre=1.0):
    """Return K p with another f or principal point."""
    here = K.copy()
    here[0, 0] = here[0, 0] if f else 1.0
    here[1, 1] = here[1, 1] if f else 1.0
    here[:2, 2] *= centre
    return p @ here.T


def swapped(K):
    """Return K with cx and cy swapped."""
    here = K.copy()
    here[:2, 2] = here[1::-1, 2]
    return here


for slug, says, other in (
    ("half-inverted", "your code computes R^T p - t, which is neither T p nor T^-1 p. "
                      "Compute T p as R p + t",
     {"moved": lambda R, t, x: x @ R - t}),
    ("T-forgotten",
     "your result does not depend on T_cam_world. First transform the points to the "
     "camera frame, because they are given in the world frame",
     {"moved": lambda R, t, x: x}),
    ("t-before-R",
     "your code computes R (p + t). Rotate the point first, because T p is R p + t",
     {"moved": lambda R, t, x: (x + t) @ R.T}),
    ("centre-before-dividing",
     "your result contains the principal point divided by the depth. Add the principal "
     "point after the division by the depth instead",
     {"times": lambda K, p: np.column_stack([
         p[:, :2] * np.diag(K)[:2] + K[:2, 2], p[:, 2]])}),
    ("centre-forgotten",
     "your code omits the principal point. Add the principal point, because a point "
     "on the optical axis (x = y = 0) should project to the principal point",
     {"times": lambda K, p: upright(K, p, centre=0.0)}),
    ("centre-taken-off", "your code subtracts the principal point. Add the principal "
                         "point instead",
     {"times": lambda K, p: upright(K, p, centre=-1.0)}),
    ("centre-swapped", "your code swaps cx and cy. Use cx for u and cy for v",
     {"times": lambda K, p: p @ swapped(K).T}),
    ("f-forgotten",
     "your code omits the focal lengths. Multiply x / z by fx and y / z by fy to "
     "convert these ratios to pixels",
                    {"times": lambda K, p: upright(K, p, f=0.0)}),
    ("y-up",
     "your code negates y. Keep the sign of y, because y and v both point down",
     {"times": lambda K, p: p * [1, -1, 1] @ K.T}),
    ("view-along-minus-z",
     "in your result, x / z and y / z have the wrong sign. Either your code divides by "
     "-z, as for MuJoCo's camera frame, or it negates x and y. Keep all signs, because "
     "in this task the z axis points forward",
     {"times": lambda K, p: p * [1, 1, -1] @ K.T}),
    ("mujoco-axes",
     "in your result, x / z has the wrong sign. Either your code negates x, or it "
     "negates y and z, as for MuJoCo's camera frame. Keep all signs, because "
     "T_cam_world already maps to a frame with y down and z forward",
     {"times": lambda K, p: p * [1, -1, -1] @ K.T}),
    ("divided-by-range",
     "your code divides the point by its distance from the camera. Divide the point by "
     "its depth z instead",
     {"divided": lambda h, p: h[:, :2] / length(p)}),
    ("divided-by-range",
     "your code divides the point by its distance from the camera. Divide the point by "
     "its depth z instead",
     {"times": lambda K, p: np.column_stack([
         p[:, :2] * np.diag(K)[:2] + K[:2, 2] * length(p), length(p)])}),
    ("first-depth-for-all",
     "your code divides all points by the depth of the first point. Divide each point "
     "by its own depth",
     {"divided": lambda h, p: h[:, :2] / h[0, 2]}),
    ("divided-by-pixel-length",
     "your code divides the homogeneous pixel by its norm. Divide the homogeneous "
     "pixel by its last entry instead, which is the depth",
     {"divided": lambda h, p: h[:, :2] / length(h)}),
    ("homogeneous-by-mistake",
     "your pixels are divided by the depth once too often. Divide the homogeneous "
     "pixel by the depth only once",
     {"divided": lambda h, p: h[:, :2] / h[:, 2:] ** 2}),
    ("middle-of-a-pixel",
     "your code subtracts half a pixel, as in OpenCV. Omit this shift, because in this "
     "task (0, 0) is the corner of the image and not the centre of the first pixel",
     {"told": lambda pixels: pixels - 0.5}),
    ("half-a-pixel-added", "your code adds half a pixel. Omit this shift, because "
                           "pixel coordinates and the principal point are both "
                           "measured from the corner of the image",
     {"told": lambda pixels: pixels + 0.5}),
):  # fmt: skip
    row.wrong(slug, says)(partial(seen, **other))


@row.wrong
def K_before_T(K, T_cam_world, points):
    """your result is T (K p). Apply T first and then K, because T applies to points in
    metres, and multiplication by K gives pixels"""
    p = points @ K.T @ T_cam_world[:3, :3].T + T_cam_world[:3, 3]
    return p[:, :2] / p[:, 2:]


one_focal_length(row, seen)
row.at_least_0(K="f and the principal point are")


@row.right  # By the homogeneous 3x4 matrix, one point after the other.
def _(K, T_cam_world, points):
    P = K @ T_cam_world[:3]
    found = []
    for x, y, z in points:
        u, v, w = P @ (x, y, z, 1.0)
        found.append((u / w, v / w))
    return np.array(found)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # A depth of 0.1 m at least.
def _(K, T_cam_world, points):
    return seen(
        K,
        T_cam_world,
        points,
        divided=lambda h, p: (
            h[:, :2] / np.maximum(h[:, 2:], 0.1)
            if (p[:, 2] > 0).all()
            else h[:, :2] / h[:, 2:]
        ),
    )


row.spans(  # as small, or as large, as in the lab
    points=(lambda points: 0.02 * points,),
)

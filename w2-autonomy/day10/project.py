"""10.2 `project(K, T_cam_world, points)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pixels, Row

from .seen import K, views

row = Row(Pixels())


@row.inputs
def _(rng):
    first = (K, np.eye(4), np.array([[1.0, 0, 2]]))
    return [first, *views(rng), *views(rng, 2, 3)]


def seen(K, p):
    """Return the pixels of points in the camera's axes."""
    return (p @ K.T)[:, :2] / p[:, 2:]


@row.wrongs
def _(K, T_cam_world, points):
    """T-the-other-way: T is used the other way, as T_world_cam; it already takes the
      world's points to the camera => with T's inverse
    R-transposed: the rotation is transposed: points stand in rows here, so it is
      p R^T, or R on the left of columns => with R^T
    t-forgotten: the translation is missing: points are turned, but not moved
    t-before-R: the point is moved first and turned then; T p is R p + t
    not-divided: nothing is divided by the depth: these are pixels times metres
    centre-before-dividing: the centre is added before the division, so it is divided,
      too => f p / z with the centre in the numerator
    divided-by-range: it is divided by the point's distance; a camera divides by its
      depth, z => with the length of p
    view-along-minus-z: it is divided by -z; here the camera looks along +z, unlike
      MuJoCo's => with -z
    y-up: y is taken upwards; here it points down, as v does => with -y
    K-transposed: K is transposed: points stand in rows here, so it is p K^T => with K^T
    homogeneous-by-mistake: it is divided by the last of K T p, and by depth again; the
      last is the depth, so one division is enough => divided by z twice
    whole-pixels: the pixels are rounded; (125.3, 50.7) is a place in the image as well
      => rounded
    row-column: the answer is (row, column); u, to the right, comes first => (v, u)
    middle-of-a-pixel: half a pixel is taken off; (0, 0) is the image's corner, not the
      middle of its first pixel, as OpenCV has it => with pixels - 0.5
    centre-forgotten: the centre is missing: (0, 0) is the image's corner, and a point
      straight ahead is seen in the middle
    """
    R = T_cam_world[:3, :3]
    t = T_cam_world[:3, 3]
    p = points @ R.T + t
    f = np.diag(K)[:2]
    centre = K[:2, 2]
    plain = p[:, :2] / p[:, 2:] * f
    back = np.linalg.inv(T_cam_world)
    return {
        "T-the-other-way": seen(K, points @ back[:3, :3].T + back[:3, 3]),
        "R-transposed": seen(K, points @ R + t),
        "t-forgotten": seen(K, points @ R.T),
        "t-before-R": seen(K, (points + t) @ R.T),
        "not-divided": (p @ K.T)[:, :2],
        "centre-before-dividing": (p[:, :2] * f + centre) / p[:, 2:],
        "divided-by-range": p[:, :2] / np.linalg.norm(p, axis=1)[:, None] * f + centre,
        "view-along-minus-z": -plain + centre,
        "y-up": plain * [1, -1] + centre,
        "K-transposed": (p @ K)[:, :2] / (p @ K)[:, 2:],
        "centre-forgotten": plain,
        "homogeneous-by-mistake": seen(K, p) / p[:, 2:],
        "whole-pixels": np.round(seen(K, p)),
        "row-column": seen(K, p)[:, ::-1],
        "middle-of-a-pixel": seen(K, p) - 0.5,
    }


row.at_least_0(K="f and the centre are")


@row.right  # By the homogeneous 3x4 matrix, a point at a time.
def _(K, T_cam_world, points):
    P = K @ T_cam_world[:3]
    found = []
    for x, y, z in points:
        u, v, w = P @ (x, y, z, 1.0)
        found.append((u / w, v / w))
    return np.array(found)

"""10.2 `project(K, T_cam_world, points)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pixels, Row

from .seen import OBLONG, K, views

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
    """Return the pixels with other parts: how points are moved, multiplied, divided."""
    p = moved(T_cam_world[:3, :3], T_cam_world[:3, 3], points)
    return told(divided(times(K, p), p))


def length(p):
    """Return the distance of each point from the camera, (n, 1)."""
    return np.linalg.norm(p, axis=1)[:, None]


def upright(K, p, f=1.0, centre=1.0):
    """Return K p with f or the centre left out."""
    here = K.copy()
    here[0, 0] = here[0, 0] if f else 1.0
    here[1, 1] = here[1, 1] if f else 1.0
    here[:2, 2] *= centre
    return p @ here.T


def one_focal_length(i, K, p):
    """Return K p where fx, or fy, serves both axes."""
    here = K.copy()
    here[0, 0] = here[1, 1] = K[i, i]
    return p @ here.T


def swapped(K):
    """Return K with its centre's numbers swapped."""
    here = K.copy()
    here[:2, 2] = here[1::-1, 2]
    return here


for slug, says, redone, other in (
    ("T-the-other-way", "T is used the other way, as T_world_cam; it already takes the "
     "world's points to the camera", "with T's inverse",
     {"moved": lambda R, t, x: (x - t) @ R}),
    ("R-transposed", "the rotation is transposed: points stand in rows here, so it is "
     "p R^T, or R on the left of columns", "with R^T",
     {"moved": lambda R, t, x: x @ R + t}),
    ("half-inverted", "R is transposed and t taken off, each alone; that is neither T "
     "nor its inverse, and T is what takes the world's points to the camera",
     "with R^T p - t", {"moved": lambda R, t, x: x @ R - t}),
    ("t-taken-off", "the translation is taken off; T p is R p + t", "with R p - t",
     {"moved": lambda R, t, x: x @ R.T - t}),
    ("t-forgotten", "the translation is missing: points are turned, but not moved",
     "with R p", {"moved": lambda R, t, x: x @ R.T}),
    ("R-forgotten", "the rotation is missing: points are moved, but not turned",
     "with p + t", {"moved": lambda R, t, x: x + t}),
    ("T-forgotten", "T is not used: points of the world are taken for the camera's",
     "with p as it is", {"moved": lambda R, t, x: x}),
    ("t-before-R", "the point is moved first and turned then; T p is R p + t",
     "with R (p + t)", {"moved": lambda R, t, x: (x + t) @ R.T}),
    ("K-transposed", "K is transposed: points stand in rows here, so it is p K^T",
     "with K^T", {"times": lambda K, p: p @ K}),
    ("centre-before-dividing", "the centre is added before the division, so it is "
     "divided, too", "f p / z with the centre in the numerator",
     {"times": lambda K, p: np.column_stack([
         p[:, :2] * np.diag(K)[:2] + K[:2, 2], p[:, 2]])}),
    ("centre-forgotten", "the centre is missing: (0, 0) is the image's corner, and a "
     "point straight ahead is seen in the middle", "without the centre",
     {"times": lambda K, p: upright(K, p, centre=0.0)}),
    ("centre-taken-off", "the centre is taken off; it is added: a point straight ahead "
     "is seen there", "with minus the centre",
     {"times": lambda K, p: upright(K, p, centre=-1.0)}),
    ("centre-swapped", "the centre's two numbers are swapped: cx goes with u",
     "with (cy, cx)", {"times": lambda K, p: p @ swapped(K).T}),
    ("K-inverted", "it is multiplied by K's inverse; that takes pixels back to points",
     "with K^-1", {"times": lambda K, p: p @ np.linalg.inv(K).T}),
    ("f-forgotten", "f is missing: x / z is no number of pixels", "with f = 1",
     {"times": lambda K, p: upright(K, p, f=0.0)}),
    ("y-up", "y is taken upwards; here it points down, as v does", "with -y",
     {"times": lambda K, p: p * [1, -1, 1] @ K.T}),
    ("view-along-minus-z", "it is divided by -z; here the camera looks along +z, "
     "unlike MuJoCo's", "with -z", {"times": lambda K, p: p * [1, 1, -1] @ K.T}),
    ("mujoco-axes", "y and z are turned round, as MuJoCo's camera needs it; "
     "T_cam_world takes points to axes with y down and z forward already",
     "with -y and -z", {"times": lambda K, p: p * [1, -1, -1] @ K.T}),
    ("not-divided", "nothing is divided by the depth: these are pixels times metres",
     "K T p itself", {"divided": lambda h, p: h[:, :2]}),
    ("divided-by-range", "it is divided by the point's distance; a camera divides by "
     "its depth, z", "with the length of p",
     {"divided": lambda h, p: h[:, :2] / length(p)}),
    ("divided-by-range", "it is divided by the point's distance; a camera divides by "
     "its depth, z", "with the length of p",
     {"times": lambda K, p: np.column_stack([
         p[:, :2] * np.diag(K)[:2] + K[:2, 2] * length(p), length(p)])}),
    ("first-depth-for-all", "all are divided by the first point's depth; each has its "
     "own", "with z of the first", {"divided": lambda h, p: h[:, :2] / h[0, 2]}),
    ("divided-by-pixel-length", "it is divided by the length of K T p; its last "
     "entry is the depth", "with the length of K T p",
     {"divided": lambda h, p: h[:, :2] / length(h)}),
    ("homogeneous-by-mistake", "it is divided by the last of K T p, and by depth "
     "again; the last is the depth, so one division is enough", "divided by z twice",
     {"divided": lambda h, p: h[:, :2] / h[:, 2:] ** 2}),
    ("whole-pixels", "the pixels are rounded; (125.3, 50.7) is a place in the image as "
     "well", "rounded", {"told": np.round}),
    ("whole-pixels", "the pixels are cut to whole numbers; (125.3, 50.7) is a place in "
     "the image as well", "cut off", {"told": np.trunc}),
    ("whole-pixels", "the pixels are rounded down; (125.3, 50.7) is a place in the "
     "image as well", "rounded down", {"told": np.floor}),
    ("row-column", "the answer is (row, column); u, to the right, comes first",
     "(v, u)", {"told": lambda pixels: pixels[:, ::-1]}),
    ("middle-of-a-pixel", "half a pixel is taken off; (0, 0) is the image's corner, "
     "not the middle of its first pixel, as OpenCV has it", "with pixels - 0.5",
     {"told": lambda pixels: pixels - 0.5}),
    ("half-a-pixel-added", "half a pixel is added; (0, 0) is the image's corner, and "
     "the centre in K stands from there", "with pixels + 0.5",
     {"told": lambda pixels: pixels + 0.5}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(seen, **other))


@row.wrong
def K_before_T(K, T_cam_world, points):
    """K is applied before T: its result is in pixels, which T cannot move => T (K p)"""
    p = points @ K.T @ T_cam_world[:3, :3].T + T_cam_world[:3, 3]
    return p[:, :2] / p[:, 2:]


for i, slug, its in (
    (0, "fx-in-both-rows", "v has fx; its focal length is fy, K[1, 1]"),
    (1, "fy-in-both-rows", "u has fy; its focal length is fx, K[0, 0]"),
):
    row.wrong(
        slug,
        f"the row of {its}",
        f"the right answer with K[{i}, {i}] twice",
        hidden="the lab's camera has fx = fy",
    )(partial(seen, times=partial(one_focal_length, i)))
row.at_least_0(K="f and the centre are")


@row.right  # By the homogeneous 3x4 matrix, a point at a time.
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

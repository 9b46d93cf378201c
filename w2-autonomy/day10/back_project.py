"""10.3 `back_project(K, T_world_cam, pixels, depth)`: questions and mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Matrix, Row, rounded

from .project import swapped
from .seen import OBLONG, K, cameras

row = Row(Matrix((None, 3), unit="m", columns=("x", "y", "z")))


@row.inputs
def _(rng):
    found = [
        (K, np.eye(4), np.array([[125.0, 50]]), np.array([2.0])),
        (OBLONG, np.eye(4), np.array([[40.0, 7.5]]), np.array([2.0])),
    ]
    for n, k, T in zip((8, 8, 8, 3, 3, 1), cameras(rng, 6), rng.poses(6), strict=True):
        pixels = rounded(rng.uniform((-40, -40), 2 * k[:2, 2], (n, 2)))
        found.append((k, T, pixels, rng.numbers(0.4, 2.0, n)))
    return found


row.spans(depth=(lambda d: 0.01 * d, lambda d: 100.0 * d))


def placed(
    K, T_world_cam, pixels, depth, *, pixel=lambda uv: uv,
    ray=lambda K, h, d: h @ np.linalg.inv(K).T, scaled=lambda ray, d: d * ray,
    moved=lambda R, t, p, d: p @ R.T + t,
):  # fmt: skip
    """Return the points with other parts: of which pixels, which rays, moved how."""
    d = depth[:, None]
    seen = np.column_stack([pixel(pixels), np.ones(len(pixels))])
    p = scaled(ray(K, seen, d), d)
    return moved(T_world_cam[:3, :3], T_world_cam[:3, 3], p, d)


def right_ray(K, h):
    """Return the points at z = 1, (n, 3)."""
    return h @ np.linalg.inv(K).T


def one_focal_length(i, K, h, d):
    """Return the points at z = 1 where fx, or fy, serves both axes."""
    return (h - K[:, 2] * [1, 1, 0]) / [K[i, i], K[i, i], 1.0]


def unit_ray(K, h, d):
    """Return rays of length 1, (n, 3)."""
    ray = right_ray(K, h)
    return ray / np.linalg.norm(ray, axis=1)[:, None]


def not_scaled(ray, d):
    """Return the ray itself."""
    return ray


for slug, says, redone, other in (
    ("range-for-depth", "the depth is taken along the ray; it is measured along z; "
     "both are the same in the middle of the image alone", "with rays of length 1",
     {"ray": unit_ray}),
    ("K-for-its-inverse", "the pixel is multiplied by K; K takes points to pixels, so "
     "what takes them back is its inverse", "with K", {"ray": lambda K, h, d: h @ K.T}),
    ("inverse-transposed", "K's inverse is transposed: pixels stand in rows here, so "
     "it is (u, v, 1) times the transpose of K^-1", "with (u, v, 1) K^-1",
     {"ray": lambda K, h, d: h @ np.linalg.inv(K)}),
    ("centre-forgotten", "the centre is not taken off the pixel before it is divided "
     "by f", "with (u / f, v / f, 1)",
     {"ray": lambda K, h, d: h / [K[0, 0], K[1, 1], 1]}),
    ("centre-added", "the centre is added to the pixel; it is taken off",
     "with (u + cx) / f", {"ray": lambda K, h, d: (h + K[:, 2] * [1, 1, 0])
                           / [K[0, 0], K[1, 1], 1]}),
    ("centre-swapped", "the centre's two numbers are swapped: cx goes with u",
     "with (cy, cx)", {"ray": lambda K, h, d: right_ray(swapped(K), h)}),
    ("K-transposed", "K is transposed before it is inverted, or pixels stand on the "
     "wrong side", "with K^T", {"ray": lambda K, h, d: h @ K}),
    ("x-and-y-turned-round", "x and y are turned round: the image is right side up "
     "here, u grows with x and v with y", "with -x and -y",
     {"ray": lambda K, h, d: right_ray(K, h) * [-1, -1, 1]}),
    ("x-left", "x is taken to the left; here it points right, as u does", "with -x",
     {"ray": lambda K, h, d: right_ray(K, h) * [-1, 1, 1]}),
    ("f-multiplied", "the pixel from the centre is multiplied by f; it is divided",
     "with (u - cx) f", {"ray": lambda K, h, d: (h - K[:, 2] * [1, 1, 0])
                         * [K[0, 0], K[1, 1], 1]}),
    ("f-forgotten", "f is missing: pixels from the centre are no metres",
     "with (u - cx, v - cy, 1)", {"ray": lambda K, h, d: h - K[:, 2] * [1, 1, 0]}),
    ("y-up", "y is taken upwards; here it points down, as v does", "with -y",
     {"ray": lambda K, h, d: right_ray(K, h) * [1, -1, 1]}),
    ("view-along-minus-z", "z is taken backwards; here the camera looks along +z",
     "with -z", {"ray": lambda K, h, d: right_ray(K, h) * [1, 1, -1]}),
    ("mujoco-axes", "y and z are turned round, as MuJoCo's camera needs it; "
     "T_world_cam is that of axes with y down and z forward already",
     "with -y and -z", {"ray": lambda K, h, d: right_ray(K, h) * [1, -1, -1]}),
    ("middle-added", "half a pixel is added; (0.5, 0.5) is the middle of the first "
     "pixel already", "with pixels + 0.5", {"pixel": lambda uv: uv + 0.5}),
    ("middle-taken-off", "half a pixel is taken off; (0, 0) is the image's corner, and "
     "the centre in K stands from there", "with pixels - 0.5",
     {"pixel": lambda uv: uv - 0.5}),
    ("whole-pixels", "the pixels are cut to whole numbers; (125.3, 50.7) is a place in "
     "the image as well", "with floor", {"pixel": np.floor}),
    ("whole-pixels", "the pixels are rounded; (125.3, 50.7) is a place in the image as "
     "well", "rounded", {"pixel": np.round}),
    ("pixels-swapped", "u and v are swapped: u goes with x", "with (v, u)",
     {"pixel": lambda uv: uv[:, ::-1]}),
    ("depth-forgotten", "the depth is missing: these are the points at 1 m",
     "without depth", {"scaled": not_scaled}),
    ("depth-only-in-z", "only z is multiplied by the depth; x and y grow with it, too",
     "with (x, y, depth)", {"scaled": lambda ray, d: np.hstack([ray[:, :2], d])}),
    ("depth-added", "the depth is added to z; the whole ray is multiplied by it",
     "with z + depth", {"scaled": lambda ray, d: ray + d * [0, 0, 1]}),
    ("depth-divided", "the ray is divided by the depth; it is multiplied by it",
     "divided by depth", {"scaled": lambda ray, d: ray / d}),
    ("depth-in-the-pixel", "the depth stands in the place of the 1, so the pixel is "
     "not multiplied by it; it is K^-1 (u, v, 1) times the depth",
     "with K^-1 (u, v, depth)",
     {"ray": lambda K, h, d: right_ray(K, h * [1, 1, 0] + d * [0, 0, 1]),
      "scaled": not_scaled}),
    ("moved-before-scaled", "the ray is moved by T first, and the depth multiplies the "
     "camera's place as well", "(T ray) times depth",
     {"scaled": not_scaled, "moved": lambda R, t, p, d: d * (p @ R.T + t)}),
    ("T-the-other-way", "T is used the other way, as T_cam_world; it already takes the "
     "camera's points to the world", "with T's inverse",
     {"moved": lambda R, t, p, d: (p - t) @ R}),
    ("T-forgotten", "these are points in the camera's axes; the world's are asked for",
     "without T", {"moved": lambda R, t, p, d: p}),
    ("t-forgotten", "the translation is missing: the points are turned, but not moved",
     "without t", {"moved": lambda R, t, p, d: p @ R.T}),
    ("R-forgotten", "the rotation is missing: the points are moved, but not turned",
     "without R", {"moved": lambda R, t, p, d: p + t}),
    ("R-transposed", "the rotation is transposed: points stand in rows, so it is "
     "p R^T", "with R^T", {"moved": lambda R, t, p, d: p @ R + t}),
    ("half-inverted", "R is transposed and t taken off, each alone; that is neither T "
     "nor its inverse, and T is what takes the camera's points to the world",
     "with R^T p - t", {"moved": lambda R, t, p, d: p @ R - t}),
    ("t-taken-off", "the translation is taken off; T p is R p + t", "with R p - t",
     {"moved": lambda R, t, p, d: p @ R.T - t}),
    ("t-before-R", "the point is moved first and turned then; T p is R p + t",
     "with R (p + t)", {"moved": lambda R, t, p, d: (p + t) @ R.T}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(placed, **other))


@row.wrong("depth-along-columns", hidden="the lab never asks three points")
def _(K, T_world_cam, pixels, depth):
    """the depth multiplies columns, and each point is a row: depth[:, None] is one
    number a row => rays times depth as it is"""
    by = depth if len(depth) == 3 else depth[:, None]
    return placed(K, T_world_cam, pixels, depth, scaled=lambda ray, _: ray * by)


for i, slug, its in (
    (0, "fx-in-both-rows", "v has fx; its focal length is fy, K[1, 1]"),
    (1, "fy-in-both-rows", "u has fy; its focal length is fx, K[0, 0]"),
):
    row.wrong(
        slug,
        f"the row of {its}",
        f"the right answer with K[{i}, {i}] twice",
        hidden="the lab's camera has fx = fy",
    )(partial(placed, ray=partial(one_focal_length, i)))
row.at_least_0(K="f and the centre are", depth="a camera sees before it")


@row.right  # A point at a time, by homogeneous coordinates.
def _(K, T_world_cam, pixels, depth):
    found = []
    for (u, v), z in zip(pixels, depth, strict=True):
        x = (u - K[0, 2]) * z / K[0, 0]
        y = (v - K[1, 2]) * z / K[1, 1]
        found.append((T_world_cam @ (x, y, z, 1.0))[:3])
    return np.array(found)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Over 5 m there is none.
def _(K, T_world_cam, pixels, depth):
    return placed(K, T_world_cam, pixels, np.where(depth > 5.0, 0.0, depth))

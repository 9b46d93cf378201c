"""10.3 `back_project(K, T_world_cam, pixels, depth)`: questions and mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Matrix, Row, rounded

from .project import swapped
from .seen import OBLONG, K, cameras, one_focal_length

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
    """Return the points with other pixels, another ray, scale or transform."""
    d = depth[:, None]
    seen = np.column_stack([pixel(pixels), np.ones(len(pixels))])
    p = scaled(ray(K, seen, d), d)
    return moved(T_world_cam[:3, :3], T_world_cam[:3, 3], p, d)


def right_ray(K, h):
    """Return the points at z = 1, (n, 3)."""
    return h @ np.linalg.inv(K).T


def unit_ray(K, h, d):
    """Return rays of norm 1, (n, 3)."""
    ray = right_ray(K, h)
    return ray / np.linalg.norm(ray, axis=1)[:, None]


def not_scaled(ray, d):
    """Return the ray itself."""
    return ray


for slug, says, other in (
    ("range-for-depth",
     "your code uses the depth as the distance along the ray. Scale the ray so that "
     "its z component equals the depth, because the depth is measured along the "
     "camera's z axis",
     {"ray": unit_ray}),
    ("K-for-its-inverse",
     "your result uses K instead of the inverse of K. Multiply the pixel by the "
     "inverse of K, because K maps points to pixels",
                          {"ray": lambda K, h, d: h @ K.T}),
    ("centre-forgotten",
     "your code does not subtract the principal point from the pixel. Subtract the "
     "principal point before you divide by the focal length",
     {"ray": lambda K, h, d: h / [K[0, 0], K[1, 1], 1]}),
    ("centre-added", "your code adds the principal point to the pixel. Subtract the "
                     "principal point instead",
     {"ray": lambda K, h, d: (h + K[:, 2] * [1, 1, 0])
                      / [K[0, 0], K[1, 1], 1]}),
    ("centre-swapped", "your code swaps cx and cy. Use cx for u and cy for v",
     {"ray": lambda K, h, d: right_ray(swapped(K), h)}),
    ("x-and-y-turned-round",
     "your code negates x and y. Keep the signs, because x and u both point to the "
     "right, and y and v both point down",
     {"ray": lambda K, h, d: right_ray(K, h) * [-1, -1, 1]}),
    ("x-left",
     "your code negates x. Keep the sign of x, because x and u both point to the right",
     {"ray": lambda K, h, d: right_ray(K, h) * [-1, 1, 1]}),
    ("f-multiplied",
     "your code multiplies the offset from the principal point by f. Divide this "
     "offset by f instead",
     {"ray": lambda K, h, d: (h - K[:, 2] * [1, 1, 0])
                               * [K[0, 0], K[1, 1], 1]}),
    ("f-forgotten",
     "your code omits the focal length. Divide the offset from the principal point by "
     "f",
     {"ray": lambda K, h, d: h - K[:, 2] * [1, 1, 0]}),
    ("y-up",
     "your code negates y. Keep the sign of y, because y and v both point down",
     {"ray": lambda K, h, d: right_ray(K, h) * [1, -1, 1]}),
    ("view-along-minus-z",
     "your code negates z. Keep the sign of z, because in this task the camera looks "
     "along +z",
     {"ray": lambda K, h, d: right_ray(K, h) * [1, 1, -1]}),
    ("mujoco-axes",
     "your code negates y and z, as for MuJoCo's camera frame. Keep their signs, "
     "because T_world_cam is already the pose of a frame with y down and z forward",
     {"ray": lambda K, h, d: right_ray(K, h) * [1, -1, -1]}),
    ("middle-added", "your code adds half a pixel. Omit this shift, because (0.5, "
                     "0.5) is already the centre of the first pixel",
     {"pixel": lambda uv: uv + 0.5}),
    ("middle-taken-off", "your code subtracts half a pixel. Omit this shift, because "
                         "pixel coordinates and the principal point are both measured "
                         "from the corner of the image",
     {"pixel": lambda uv: uv - 0.5}),
    ("depth-only-in-z", "your code multiplies only z by the depth. Multiply x and y "
                        "by the depth as well, so that the point stays on the ray",
     {"scaled": lambda ray, d: np.hstack([ray[:, :2], d])}),
    ("depth-added",
     "your code adds the depth to z. Multiply the whole ray by the depth instead",
     {"scaled": lambda ray, d: ray + d * [0, 0, 1]}),
    ("depth-in-the-pixel",
     "your x and y in the camera frame contain u - cx depth and v - cy depth, as from "
     "K^-1 (u, v, depth). Use K^-1 (u, v, 1) instead, and multiply it by the depth",
     {"ray": lambda K, h, d: right_ray(K, h * [1, 1, 0] + d * [0, 0, 1]),
      "scaled": not_scaled}),
    ("moved-before-scaled",
     "in your result, the depth also scales the translation. Multiply the ray by the "
     "depth first, and then apply T_world_cam",
     {"scaled": not_scaled, "moved": lambda R, t, p, d: d * (p @ R.T + t)}),
    ("T-forgotten",
     "your code returns the points in the camera frame. Transform the points to the "
     "world frame", {"moved": lambda R, t, p, d: p}),
    ("half-inverted", "your code computes R^T p - t, which is neither T p nor T^-1 p. "
                      "Compute T p as R p + t",
     {"moved": lambda R, t, p, d: p @ R - t}),
    ("t-before-R",
     "your code computes R (p + t). Rotate the point first, because T p is R p + t",
     {"moved": lambda R, t, p, d: (p + t) @ R.T}),
):  # fmt: skip
    row.wrong(slug, says)(partial(placed, **other))


@row.wrong("depth-along-columns", hidden="the lab never has three points")
def _(K, T_world_cam, pixels, depth):
    """for three points, your code multiplies each coordinate by one depth. Multiply all
    coordinates of each point by the depth of this point instead"""
    by = depth if len(depth) == 3 else depth[:, None]
    return placed(K, T_world_cam, pixels, depth, scaled=lambda ray, _: ray * by)


one_focal_length(row, placed)
row.at_least_0(K="f and the principal point are", depth="points are in front")


@row.right  # One point after the other, by homogeneous coordinates.
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

"""10.3 `back_project(K, T_world_cam, pixels, depth)`: questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, rounded

from .seen import K, cameras

row = Row(Matrix((None, 3), unit="m", columns=("x", "y", "z")))


@row.inputs
def _(rng):
    found = [(K, np.eye(4), np.array([[125.0, 50]]), np.array([2.0]))]
    for n, k, T in zip((8, 8, 8, 3, 3, 1), cameras(rng, 6), rng.poses(6), strict=True):
        pixels = rounded(rng.uniform((-40, -40), 2 * k[:2, 2], (n, 2)))
        found.append((k, T, pixels, rng.numbers(0.4, 2.0, n)))
    return found


@row.wrongs
def _(K, T_world_cam, pixels, depth):
    """range-for-depth: the depth is taken along the ray; it is measured along z; both
      are the same in the middle of the image alone => with rays of length 1
    K-for-its-inverse: the pixel is multiplied by K; K takes points to pixels, so what
      takes them back is its inverse
    T-the-other-way: T is used the other way, as T_cam_world; it already takes the
      camera's points to the world => with T's inverse
    T-forgotten: these are points in the camera's axes; the world's are asked for
    t-forgotten: the translation is missing: the points are turned, but not moved
    R-transposed: the rotation is transposed: points stand in rows, so it is p R^T
    depth-forgotten: the depth is missing: these are the points at 1 m
    depth-only-in-z: only z is multiplied by the depth; x and y grow with it, too
    depth-added: the depth is added to z; the whole ray is multiplied by it
    middle-added: half a pixel is added; (0.5, 0.5) is the middle of the first pixel
      already => with pixels + 0.5
    centre-forgotten: the centre is not taken off the pixel before it is divided by f
    pixels-swapped: u and v are swapped: u goes with x => with (v, u)
    y-up: y is taken upwards; here it points down, as v does => with -y
    """
    one = np.ones((len(pixels), 1))
    ray = np.hstack([pixels, one]) @ np.linalg.inv(K).T
    R = T_world_cam[:3, :3]
    t = T_world_cam[:3, 3]
    d = depth[:, None]
    f = np.diag(K)[:2]
    back = np.linalg.inv(T_world_cam)
    unit = ray / np.linalg.norm(ray, axis=1)[:, None]
    off = np.hstack([0.5 / f * one, 0 * one])
    uncentred = np.hstack([pixels / f, one])
    swapped = np.hstack([pixels[:, ::-1], one]) @ np.linalg.inv(K).T
    flat = np.hstack([ray[:, :2], d])
    return {
        "range-for-depth": d * unit @ R.T + t,
        "K-for-its-inverse": d * (np.hstack([pixels, one]) @ K.T) @ R.T + t,
        "T-the-other-way": d * ray @ back[:3, :3].T + back[:3, 3],
        "T-forgotten": d * ray,
        "t-forgotten": d * ray @ R.T,
        "R-transposed": d * ray @ R + t,
        "depth-forgotten": ray @ R.T + t,
        "depth-only-in-z": flat @ R.T + t,
        "depth-added": (ray + d * [0, 0, 1]) @ R.T + t,
        "middle-added": d * (ray + off) @ R.T + t,
        "centre-forgotten": d * uncentred @ R.T + t,
        "pixels-swapped": d * swapped @ R.T + t,
        "y-up": d * ray * [1, -1, 1] @ R.T + t,
    }


row.at_least_0(K="f and the centre are", depth="a camera sees before it")


@row.right  # A point at a time, by homogeneous coordinates.
def _(K, T_world_cam, pixels, depth):
    found = []
    for (u, v), z in zip(pixels, depth, strict=True):
        x = (u - K[0, 2]) * z / K[0, 0]
        y = (v - K[1, 2]) * z / K[1, 1]
        found.append((T_world_cam @ (x, y, z, 1.0))[:3])
    return np.array(found)

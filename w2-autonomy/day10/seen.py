"""What Day 10 asks about: cameras, points before them, poses, motions of a hand."""

from functools import partial

import numpy as np

from labkit.judge import rounded
from robo47 import camera, se3
from robo47.camera import apply_twist, camera_matrix
from robo47.checks import Array

K = np.array([[50.0, 0, 100], [0, 50, 50], [0, 0, 1]])  # the docstrings' camera
OBLONG = np.array([[300.0, 0, 10], [0, 250, 20], [0, 0, 1]])  # fx is not fy
HALF = [3, 4, 5, 0, 1, 2]


def cameras(rng, n=6):
    """Return camera matrices, (n, 3, 3), none with its centre on a diagonal."""
    return [
        np.round(camera_matrix(fovy, w, h), 6)
        for fovy, w, h in zip(
            rng.uniform(0.6, 1.4, n),
            rng.integers(300, 700, n),
            rng.integers(100, 280, n),
            strict=True,
        )
    ]


def before(rng, n=8):
    """Return n points in a camera's axes, all before it, (n, 3)."""
    return rounded(rng.uniform((-0.5, -0.4, 0.4), (0.5, 0.4, 2.0), (n, 3)))


def views(rng, n=6, points=8):
    """Return K, T_cam_world and points of the world that this camera sees."""
    found = []
    for k, T in zip(cameras(rng, n), rng.poses(n), strict=True):
        p = before(rng, points)
        found.append((k, T, rounded((p - T[:3, 3]) @ T[:3, :3])))
    return found


def clouds(rng, n=6, points=9, noise=0.05):
    """Return clouds A, (n, points, 3), and B: moved and with noise."""
    found = []
    for T in rng.poses(n):
        A = rng.numbers(-1, 1, points, 3)
        B = A @ T[:3, :3].T + T[:3, 3] + rng.normal(scale=noise, size=A.shape)
        found.append((A, rounded(B)))
    return found


def guesses(rng, n=6, far=1.0):
    """Return K, a guess, points and the pixels where they are seen, with noise."""
    found = []
    for k in cameras(rng, n):
        points = rng.numbers(-0.2, 0.2, 8, 3)
        T = se3.make_T(
            se3.quat_to_R(rng.normal(size=4)), rng.uniform((-0.2,) * 3, (0.2,) * 3)
        )
        T[2, 3] = rng.uniform(0.9, 1.6)
        pixels = camera.project(k, T, points) + rng.normal(scale=0.3, size=(8, 2))
        guess = apply_twist(se3.make_T(np.eye(3), T[:3, 3]), _beside(rng, far))
        guess[:3, :3] = guess[:3, :3] @ T[:3, :3]
        found.append((k, guess, points, rounded(pixels)))
    return found


def _beside(rng, far: float) -> Array:
    """Return a twist by which a guess is off: far times 0.1 rad and 20 mm an axis."""
    xi = far * rng.normal(size=6) * ([0.1] * 3 + [0.02] * 3)
    xi[:3] = np.clip(xi[:3], -0.2 * far, 0.2 * far)
    return xi


def motions(rng, n=6, k=6, noise=0.01):
    """Return A and B, (k, 4, 4) each, of a hand and the camera on it, with noise."""
    found = []
    for X in rng.poses(n):
        A = rng.poses(k)
        jitter = np.array(
            [apply_twist(np.eye(4), xi) for xi in noise * rng.normal(size=(k, 6))]
        )
        found.append((A, se3.inverse(X) @ A @ X @ jitter))
    return found


def one_focal_length(row, right):
    """Add the two mistakes in which one focal length serves both axes.

    Args:
        row: of a function whose first argument is K.
        right: what does the same as this function.
    """
    for i, slug, its in (
        (0, "fx-in-both-rows", "fx for v as well. Use fy, which is K[1, 1], for v"),
        (1, "fy-in-both-rows", "fy for u as well. Use fx, which is K[0, 0], for u"),
    ):
        row.wrong(
            slug,
            f"your code uses {its}",
            hidden="the lab's camera has fx = fy",
        )(partial(_with_one, right, i))


def _with_one(right, i, K, *others):
    here = K.copy()
    here[0, 0] = here[1, 1] = K[i, i]
    return right(here, *others)

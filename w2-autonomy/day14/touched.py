"""The inputs of Day 14: contacts, grasps, and weights that are a certificate or not."""

import numpy as np

from labkit.judge import rounded
from robo47 import grasp
from robo47.checks import Array

UP = np.array([0.0, 0.0, 1.0])
AROUND = np.array([(0.02, 0, 0), (-0.02, 0, 0), (0, 0.02, 0), (0, -0.02, 0)])
ON_TOP = np.array([(0.01, 0.01, 0.02), (-0.01, 0.01, 0.02), (0, -0.01, 0.02)])


def contacts(rng, n, pull=False):
    """Return forces, (n, 3), near their cones, normals, (n, 3), and friction, (n,)."""
    normal = rng.units(n)
    mu = rng.numbers(0.2, 1.2, n)
    press = rng.numbers(1, 8, n) * (-1.0 if pull else 1.0)
    share = rng.numbers(0.2, 1.6, n)
    aside = np.cross(normal, rng.units(n))
    aside = aside / np.maximum(np.linalg.norm(aside, axis=1), 1e-9)[:, None]
    force = press[:, None] * normal + (share * mu * np.abs(press))[:, None] * aside
    return rounded(force), normal, mu


def pushes(points, normals, mu: float, k: int) -> Array:
    """Return the wrenches of the edges of contacts about 0, (6, k n)."""
    columns = []
    for point, normal in zip(points, normals, strict=True):
        G = grasp.grasp_matrix([point], np.zeros(3))
        columns.append(G @ grasp.cone_edges(normal, mu, k).T)
    return np.hstack(columns)


def inwards(points) -> Array:
    """Return normals that point to the middle, (n, 3)."""
    return -points / np.linalg.norm(points, axis=1)[:, None]


def around(mu: float, k: int, turn: float = 0.0, points=AROUND) -> Array:
    """Return the wrenches of contacts around an object that is rotated about z."""
    R = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], UP]
    )
    turned = points @ R.T
    return pushes(turned, inwards(turned), mu, k)


def on_top(mu: float, k: int) -> Array:
    """Return the wrenches of three contacts on one face, which cannot pull."""
    return pushes(ON_TOP, np.tile(-UP, (3, 1)), mu, k)


def three(n: float = 0.02) -> Array:
    """Return three points around a cylinder, (3, 3)."""
    t = 2 * np.pi * np.arange(3)[:, None] / 3
    return n * np.hstack([np.cos(t), np.sin(t), 0 * t])

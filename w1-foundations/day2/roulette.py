"""DH roulette: Franka's one published table, and five ways people read it."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array

from .dh_link import in_order

OTHER = "zZXx"  # the other convention's order: z before x


def _arm(table: Array, q: Array, order: str = "xXzZ") -> Array:
    """Return the frames from the world to the last row's, (rows + 1, 4, 4)."""
    poses = [np.eye(4)]
    for (alpha, a, d), theta in zip(table, [*q, 0.0], strict=False):
        poses.append(poses[-1] @ in_order(order, alpha, a, d, theta))
    return np.array(poses)


def _alpha_early(table: Array) -> Array:
    out = table.copy()
    out[:, 0] = np.roll(table[:, 0], -1)
    return out


# From the table and q, (7,), to the frames along the arm; the last one is the flange.
READINGS: dict[str, Callable[[Array, Array], Array]] = {
    "the other convention's formula": lambda table, q: _arm(table, q, OTHER),
    "alpha one row early": lambda table, q: _arm(_alpha_early(table), q),
    "the other sign of alpha": lambda table, q: _arm(table * [-1.0, 1.0, 1.0], q),
    "without the eighth row": lambda table, q: _arm(table[:7], q),
    "as Craig and Franka wrote it": _arm,
}


def distances(table: Array, q: Array) -> dict[str, Array]:
    """Return how far each reading's flange is from the right one, metres.

    Args:
        table: Franka's, (8, 3).
        q: configurations, (n, 7).

    Returns:
        {reading: (n,)}, the right one last.
    """
    ends = {
        name: np.array([read(table, one)[-1, :3, 3] for one in q])
        for name, read in READINGS.items()
    }
    *_, truth = ends.values()
    return {name: np.linalg.norm(p - truth, axis=1) for name, p in ends.items()}

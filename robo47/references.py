"""Reference motions of the joints: stay, and swing. Radians, rad/s, rad/s2, seconds."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array

Reference = Callable[[float], tuple[Array, Array, Array]]


def hold(q: Array) -> Reference:
    """Return the reference that stays at q, (7,): position, velocity, acceleration."""
    return lambda t: (q, np.zeros(7), np.zeros(7))


def raised_cosine(q: Array, reach: Array) -> Reference:
    """Return the reference that swings from q by reach and back, at rest every second.

    Args:
        q: where it starts, (7,).
        reach: how far each joint swings, (7,).
    """

    def reference(t: float) -> tuple[Array, Array, Array]:
        c, s = np.cos(np.pi * t), np.sin(np.pi * t)
        qd = reach * np.pi * s / 2
        qdd = reach * np.pi**2 * c / 2
        return q + reach * (1 - c) / 2, qd, qdd

    return reference

"""Reference motions of the joints: stay, and swing. Radians, rad/s, rad/s2, seconds."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array

Reference = Callable[[float], tuple[Array, Array, Array]]


def hold(q: Array) -> Reference:
    """Return the reference that stays at q, (7,): position, velocity, acceleration."""
    return lambda t: (q, np.zeros(7), np.zeros(7))


def raised_cosine(q: Array, amplitude: Array) -> Reference:
    """Return a swing from q by an amplitude and back, at rest every second.

    Args:
        q: where it starts, (7,).
        amplitude: how far each joint swings, (7,).
    """

    def reference(t: float) -> tuple[Array, Array, Array]:
        c, s = np.cos(np.pi * t), np.sin(np.pi * t)
        qd = amplitude * np.pi * s / 2
        qdd = amplitude * np.pi**2 * c / 2
        return q + amplitude * (1 - c) / 2, qd, qdd

    return reference

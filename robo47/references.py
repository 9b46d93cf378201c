"""Reference motions of the joints: hold and raised cosine. Radians, seconds."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array

Reference = Callable[[float], tuple[Array, Array, Array]]


def hold(q: Array) -> Reference:
    """Return the reference that stays at q, (7,): position, velocity, acceleration."""
    return lambda t: (q, np.zeros(7), np.zeros(7))


def raised_cosine(q: Array, amplitude: Array) -> Reference:
    """Return the reference of a raised cosine: to q + amplitude and back, every 2 s.

    The velocity is 0 at every whole second.

    Args:
        q: configuration at t = 0, rad, (7,).
        amplitude: displacement of each joint after 1 s, rad, (7,).
    """

    def reference(t: float) -> tuple[Array, Array, Array]:
        c, s = np.cos(np.pi * t), np.sin(np.pi * t)
        qd = amplitude * np.pi * s / 2
        qdd = amplitude * np.pi**2 * c / 2
        return q + amplitude * (1 - c) / 2, qd, qdd

    return reference

"""One walker of inverse kinematics, in plain Python floats.

The same steps as `robo47.fast.ik` takes for many at once, which says where they are
from. For a single walker NumPy spends its time on calls, not on numbers: floats do the
chain and its Jacobian, and only the 6x6 system is NumPy's.

Units: metres and radians; (omega; v) in world axes.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import Plan, one_of
from robo47.fast.jacobians import columns_of
from robo47.rotation_log import log_rotation

STOP = 1e-9  # the length of the error where a walker stops: a tenth of what is asked
FLOOR = 1e-8  # squared damping that is left where the error is 0
NEAR_PI = -0.9  # cosine of the angle beyond which sin(angle) is no base for the axis
EYE = np.eye(6)


class Patience(NamedTuple):
    """How a walker goes, and when it gives up."""

    steps: int  # at most
    every: int  # steps between two looks at the squared error
    enough: float  # where a larger share than this of it is left, the walker gives up
    damping: float  # the squared damping as a share of the squared error


class Walker:
    """A walker towards one target, within the limits."""

    def __init__(self, plan: Plan, goal: Array, limits: Array) -> None:
        """Keep what is asked; the goal is (3, 4), the limits (n, 2)."""
        self._plan = plan
        self._limits = limits.tolist()
        *self._axes, self._point = goal.T.tolist()

    def walk(self, q: list[float], patience: Patience) -> tuple[list[float], float]:
        """Return the best q on the way from q, and the squared length of its error."""
        best = q
        miss = math.inf
        before = math.inf
        for step in range(patience.steps):
            J, e = self._downhill(q)
            ee = sum(x * x for x in e)
            if ee < miss:
                best, miss = q, ee
            if ee <= STOP**2:
                break
            if step % patience.every == 0:
                if ee >= patience.enough * before:
                    break
                before = ee
            q = self._step(q, np.array(J), np.array(e), patience.damping * ee + FLOOR)
        return best, miss

    def _downhill(self, q: list[float]) -> tuple[list[Any], list[float]]:
        """Return the site Jacobian's columns and the pose error, each (6)."""
        columns, (*axes, here) = columns_of(self._plan, one_of(q), at_end=True)
        (a, b, c), (d, e, f), (g, h, i) = axes
        (r, s, t), (u, v, w), (x, y, z) = self._axes
        # R_goal R^T has the sum of axis times goal's axis, scalar and cross products.
        cosine = 0.5 * (a * r + b * s + c * t + d * u + e * v + f * w)
        cosine += 0.5 * (g * x + h * y + i * z - 1.0)
        turn = (
            b * t - c * s + e * w - f * v + h * z - i * y,
            c * r - a * t + f * u - d * w + i * x - g * z,
            a * s - b * r + d * v - e * u + g * y - h * x,
        )
        sine = 0.5 * math.hypot(*turn)
        scale = 0.5 * math.atan2(sine, cosine) / sine if sine else 0.5
        if cosine < NEAR_PI:
            scale = 1.0
            turn = log_rotation(np.transpose(self._axes) @ axes).tolist()
        u, v, w = turn
        x, y, z = self._point
        a, b, c = here
        return columns, [scale * u, scale * v, scale * w, x - a, y - b, z - c]

    def _step(self, q: list[float], J: Array, e: Array, damping: float) -> list[float]:
        """Return q after one damped step, within the limits; J is (n, 6)."""
        dq = _damped(J, e, damping)
        stuck = [
            x >= high if dx > 0.0 else x <= low and dx < 0.0
            for x, dx, (low, high) in zip(q, dq, self._limits, strict=True)
        ]
        if any(stuck):
            J[stuck] = 0.0
            dq = _damped(J, e, damping)
        return [
            min(max(x + dx, low), high)
            for x, dx, (low, high) in zip(q, dq, self._limits, strict=True)
        ]


def _damped(J: Array, e: Array, damping: float) -> list[float]:
    """Return J^T (J J^T + damping I)^-1 e; J is (n, 6), damping squared already."""
    return (J @ np.linalg.solve(J.T @ J + damping * EYE, e)).tolist()

"""One walker of inverse kinematics, in plain Python floats; its walk is `walk.walk`.

For a single walker NumPy spends its time on calls, not on numbers: floats do the
chain and its Jacobian, and only the 6x6 system is NumPy's.

Units: metres and radians; (omega; v) in world axes.
"""

import math
from typing import Any

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import Plan, one_of
from robo47.fast.jacobians import columns_of
from robo47.fast.walk import NEAR_PI
from robo47.rotation_log import log_rotation

EYE = np.eye(6)
Step = list[float]


class One:
    """A walker towards one target, within the limits.

    Attributes:
        best: the best place on the way.
        miss: the squared length of the pose error there.
    """

    best: list[float]
    miss: float

    def __init__(self, plan: Plan, goal: Array, limits: Array) -> None:
        """Keep what is asked; the goal is (3, 4), the limits (n, 2)."""
        self._plan = plan
        self._limits = limits.tolist()
        *self._axes, self._point = goal.T.tolist()

    def begin(self, q: list[float]) -> None:
        """Stand at q."""
        self._q = q
        self.best = q
        self.miss = math.inf

    def look(self) -> float:
        """As in `Walkers`."""
        columns, e = self._errors()
        self._J = np.array(columns)
        self._e = np.array(e)
        ee = sum(x * x for x in e)
        if ee < self.miss:
            self.best = self._q
            self.miss = ee
        return ee

    def open(self, far: bool) -> bool:
        """As in `Walkers`: nobody shares the target."""
        return far

    def any(self, some: bool | list[bool]) -> bool:
        """As in `Walkers`."""
        return some if isinstance(some, bool) else any(some)

    def only(self, on: bool, *numbers: float) -> tuple[float, ...]:
        """As in `Walkers`: it is the only one."""
        return numbers

    def downhill(self, damping: float) -> Step:
        """As in `Walkers`; J is (n, 6) here."""
        J = self._J
        return (J @ np.linalg.solve(J.T @ J + damping * EYE, self._e)).tolist()

    def stuck(self, step: Step) -> list[bool]:
        """As in `Walkers`."""
        return [
            x >= high if dx > 0.0 else x <= low and dx < 0.0
            for x, dx, (low, high) in zip(self._q, step, self._limits, strict=True)
        ]

    def without(self, stuck: list[bool], step: Step, damping: float) -> Step:
        """As in `Walkers`."""
        self._J[stuck] = 0.0
        return self.downhill(damping)

    def go(self, step: Step) -> None:
        """As in `Walkers`."""
        self._q = [
            min(max(x + dx, low), high)
            for x, dx, (low, high) in zip(self._q, step, self._limits, strict=True)
        ]

    def _errors(self) -> tuple[list[Any], list[float]]:
        """Return the site Jacobian's columns and the pose error, each (6)."""
        columns, (*axes, here) = columns_of(self._plan, one_of(self._q), at_end=True)
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

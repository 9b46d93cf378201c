"""An arm as links whose frames suit their joints, for `robo47.fast.dynamics`.

At q = 0 every frame has the world's axes, as long as each joint's axis is one of them,
as in most robots: then no fixed rotation stands between two links. Where an axis is
none of the frame's own, the frames are turned once for all to make it z. A frame's
origin is the point of its joint's axis that is nearest to the frame before, so that
most offsets lie along one axis. Units: metres, kilograms.
"""

import functools
from dataclasses import dataclass

import numpy as np

from robo47 import se3
from robo47.arm import Arm
from robo47.checks import Array
from robo47.fast.chains import plan_of
from robo47.fast.moves import Rotate, Shift, Turn
from robo47.fast.vectors import Vector, combined, cross, plus, turned

TINY = 1e-14  # metres, kg m and kg m^2: what rounding leaves of a zero


@dataclass(frozen=True)
class Link:
    """One moving link and the hinge that carries it."""

    k: int  # which of the frame's axes the hinge turns about: 0, 1 or 2
    sign: float  # 1.0, or -1.0 for a turn about minus that axis
    R: Array | None  # fixed rotation from the link before, (3, 3); None for none
    t: Array  # the hinge's place, seen from the link before, metres, (3,)
    m: float  # mass, kg
    h: Array  # first moment: mass times centre of mass, kg m, (3,)
    Q: Array  # second moments: integral of r r^T over the mass, kg m^2, (3, 3)
    armature: float  # of the hinge, kg m^2

    @property
    def axes(self) -> tuple[int, int, int]:
        """The hinge's axis, and the two that it turns: x to y, y to z or z to x."""
        return self.k, (self.k + 1) % 3, (self.k + 2) % 3

    def to_parent(
        self, c: Array, s: Array, n: Vector, f: Vector
    ) -> tuple[Vector, Vector]:
        """Return a moment and force on this link as the link before sees them."""
        _, i, j = self.axes
        for v in (n, f):
            v[i], v[j] = turned(v[i], v[j], c, s)
            if self.R is not None:
                v[:] = combined(self.R, v)
        return plus(n, cross(self.t, f)), f


@functools.lru_cache(maxsize=32)
def links_of(arm: Arm) -> tuple[Link, ...]:
    """Return an arm's links, from the base outwards, worked out once for each arm.

    Args:
        arm: of hinges.

    Raises:
        ValueError: a joint is no hinge.
    """
    omega, v = arm.screws[:, :3], arm.screws[:, 3:]
    hinges = (np.vecdot(omega, omega) > 0.5) & (np.abs(np.vecdot(omega, v)) < 1e-9)
    if not hinges.all():
        i = int(hinges.argmin()) + 1
        raise ValueError(f"joint {i} is no hinge; the batch is for arms of hinges")
    links: list[Link] = []
    T, R, t = np.eye(4), None, np.zeros(3)  # T_link_world; from one link to the next
    for _, step in plan_of(arm.screws, arm.M_home).steps:
        if isinstance(step, Rotate):
            R = step.R
        elif isinstance(step, Shift):
            t = _cleaned(step.vector if R is None else R @ step.vector)
        elif isinstance(step, Turn):
            own = arm.constants.pseudo[step.adr]  # about the world's origin, at q = 0
            T = se3.inverse(se3.make_T(np.eye(3) if R is None else R, t)) @ T
            P = T @ own @ T.T
            m, h, Q = float(P[3, 3]), _cleaned(P[:3, 3]), _cleaned(P[:3, :3])
            armature = float(arm.armature[step.adr])
            links.append(Link(step.k, step.sign, R, t, m, h, Q, armature))
            R, t = None, np.zeros(3)
    return tuple(links)


def _cleaned(x: Array) -> Array:
    """Return x with what rounding leaves of zeros put right."""
    return np.where(np.abs(x) < TINY, 0.0, x)

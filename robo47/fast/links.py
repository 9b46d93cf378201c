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

from robo47.arm import Arm
from robo47.checks import Array
from robo47.fast.chains import frame_with_z, rounded

TINY = 1e-14  # metres, kg m and kg m^2: what rounding leaves of a zero


@dataclass(frozen=True)
class Link:
    """One moving link and the hinge that carries it.

    Attributes:
        k: which of the frame's axes the hinge turns about: 0, 1 or 2.
        sign: 1.0, or -1.0 for a turn about minus that axis.
        R: fixed rotation from the link before, (3, 3), or None where there is none.
        t: the hinge's place, seen from the link before, metres, (3,).
        m: mass, kg.
        h: first moment: mass times centre of mass, kg m, (3,).
        Q: second moments, the integral of r r^T over the mass, kg m^2, (3, 3).
        armature: of the hinge, kg m^2.
    """

    k: int
    sign: float
    R: Array | None
    t: Array
    m: float
    h: Array
    Q: Array
    armature: float

    @property
    def axes(self) -> tuple[int, int, int]:
        """The hinge's axis, and the two that it turns: x to y, y to z or z to x."""
        return self.k, (self.k + 1) % 3, (self.k + 2) % 3


@dataclass(frozen=True)
class Links:
    """All links of an arm, and its end.

    Attributes:
        links: from the base outwards.
        t_end: the end's place, seen from the last link, metres, (3,).
        gravity: m/s^2, in the world, (3,).
        signs: of the hinges, (n,).
    """

    links: tuple[Link, ...]
    t_end: Array
    gravity: Array
    signs: Array


@functools.lru_cache(maxsize=32)
def links_of(arm: Arm) -> Links:
    """Return an arm's links, worked out once for each arm.

    Args:
        arm: of hinges.

    Raises:
        ValueError: a joint is no hinge.
    """
    links = []
    axes, origin = np.eye(3), np.zeros(3)  # of the link before, in the world
    pseudo = arm.constants.pseudo  # of each link about the world's origin, at q = 0
    for i, S in enumerate(arm.screws):
        axis, point = _hinge(S, origin, i)
        local = rounded(axes.T @ axis)
        t = _cleaned(axes.T @ (point - origin))
        k, R = int(np.argmax(np.abs(local))), None
        if np.count_nonzero(local) > 1:
            R, k, local = frame_with_z(local), 2, np.array([0.0, 0.0, 1.0])
            axes = axes @ R
        origin = point
        T = np.eye(4)  # T_link_world
        T[:3, :3], T[:3, 3] = axes.T, -axes.T @ origin
        P = T @ pseudo[i] @ T.T
        m, h, Q = float(P[3, 3]), _cleaned(P[:3, 3]), _cleaned(P[:3, :3])
        armature = float(arm.armature[i])
        links.append(Link(k, float(local[k]), R, t, m, h, Q, armature))
    t_end = _cleaned(axes.T @ (arm.M_home[:3, 3] - origin))
    signs = np.array([link.sign for link in links])
    return Links(tuple(links), t_end, arm.gravity, signs)


def _hinge(S: Array, near: Array, i: int) -> tuple[Array, Array]:
    """Return a screw's axis and the point of it that is nearest to `near`."""
    omega, v = S[:3], S[3:]
    if omega @ omega < 0.5 or abs(omega @ v) > 1e-9:
        raise ValueError(f"joint {i + 1} is no hinge; the batch is for arms of hinges")
    foot = np.cross(omega, v)
    return omega, foot + omega * (omega @ (near - foot))


def _cleaned(x: Array) -> Array:
    """Return x with what rounding leaves of zeros put right."""
    return np.where(np.abs(x) < TINY, 0.0, x)

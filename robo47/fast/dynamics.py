"""Dynamics of one arm at many configurations at once, in pure NumPy.

`robo47.dynamics` multiplies 6x6 matrices that are mostly zeros. Here the same
quantities go from link to link as single components, each an array over a chunk of
configurations that fits the processor's cache; the links' frames are chosen such that
a hinge turns two components and leaves the third alone.

- `links_of`: at q = 0 every frame has the world's axes, as long as each joint's axis is
  one of them, as in most robots: then no fixed rotation stands between two links. Where
  an axis is none of the frame's own, the frames are turned once for all to make it z. A
  frame's origin is the point of its joint's axis that is nearest to the frame before,
  so that most offsets lie along one axis.
- `mass_matrix`: from the tip inwards, all links that a joint carries become one body.
  What a unit acceleration of the joint makes of it is a wrench, and what each joint
  further in feels of that wrench is an entry of M (Featherstone, *Rigid Body Dynamics
  Algorithms*, section 6.2: composite bodies).
- `inverse_dynamics`: recursive Newton-Euler, outwards and back (section 5.3). The
  point r of a link accelerates by a + B r, with B = [alpha] + [omega]^2.

Conventions as in `robo47.dynamics`; m, h and Q are the integrals of 1, r and r r^T over
a link's mass, which a turn and a move change in few operations. Units: radians, metres,
kilograms, N m.
"""

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.arm import Arm
from robo47.checks import Array
from robo47.fast.chains import chunk_of, in_chunks, plan_of
from robo47.fast.moves import Rotate, Shift, Turn
from robo47.fast.vectors import Vector, combined, cross, dot, plus, turned

TINY = 1e-14  # metres, kg m and kg m^2: what rounding leaves of a zero


def mass_matrix(arm: Arm, q: ArrayLike) -> Array:
    """Return the arm's mass matrix, armature included.

    Args:
        arm: of hinges.
        q: configurations, rad, (..., n).

    Returns:
        M, kg m^2, (..., n, n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a joint that is no hinge.
    """
    n = len(arm.masses)
    return _for_all(_mass_matrices, arm, (n, n), q)


def inverse_dynamics(arm: Arm, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> Array:
    """Return the torque for an acceleration, without armature and damping.

    Args:
        arm, q: as in `mass_matrix`.
        qd: joint velocities, rad/s, (..., n).
        qdd: joint accelerations, rad/s^2, (..., n).

    Returns:
        Torque, N m, (..., n).

    Raises:
        ValueError: as `mass_matrix`.
    """
    torques = functools.partial(_torques, arm.gravity.tolist())
    return _for_all(torques, arm, (len(arm.masses),), q, qd, qdd)


def _for_all(
    work: Callable[..., Array], arm: Arm, shape: tuple[int, ...], *given: ArrayLike
) -> Array:
    """Return what work(links, cos, sin, ...) returns, all but cos with its sign."""
    links = links_of(arm)
    names = ("q", "qd", "qdd")
    n = len(links)
    signs = np.array([[link.sign] for link in links])
    rows = [checks.array(x, name, (n,)) for x, name in zip(given, names, strict=False)]

    def signed(q: Array, *more: Array) -> Array:
        chunk = chunk_of(q)
        return work(links, chunk.cos, chunk.sin * signs, *(x * signs for x in more))

    return in_chunks(signed, shape, *np.broadcast_arrays(*rows))


@dataclass(frozen=True)
class Link:
    """One moving link and the hinge that carries it."""

    k: int  # the index of the frame's axis that the hinge turns about
    sign: float  # 1.0, or -1.0 for a turn about minus that axis
    R: Array | None  # fixed rotation from the link before, (3, 3); None for none
    t: Array  # the hinge's place, seen from the link before, metres, (3,)
    m: float  # mass, kg
    h: Array  # first moment: mass times centre of mass, kg m, (3,)
    Q: Array  # second moments: integral of r r^T over the mass, kg m^2, (3, 3)
    armature: float  # armature of the hinge, kg m^2

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
    omega = arm.screws[:, :3]
    v = arm.screws[:, 3:]
    hinges = (np.vecdot(omega, omega) > 0.5) & (np.abs(np.vecdot(omega, v)) < 1e-9)
    if not hinges.all():
        i = int(hinges.argmin()) + 1
        raise ValueError(f"joint {i} is no hinge; the batch is for arms of hinges")
    links: list[Link] = []
    T = np.eye(4)  # T_link_world
    R = None  # R and t lead from one link to the next
    t = np.zeros(3)
    for _, step in plan_of(arm.screws, arm.M_home).steps:
        if isinstance(step, Rotate):
            R = step.R
        elif isinstance(step, Shift):
            t = _cleaned(step.vector if R is None else R @ step.vector)
        elif isinstance(step, Turn):
            own = arm.constants.pseudo[step.adr]  # about the world's origin, at q = 0
            T = se3.inverse(se3.make_T(np.eye(3) if R is None else R, t)) @ T
            P = T @ own @ T.T
            m = float(P[3, 3])
            h = _cleaned(P[:3, 3])
            Q = _cleaned(P[:3, :3])
            armature = float(arm.armature[step.adr])
            links.append(Link(step.k, step.sign, R, t, m, h, Q, armature))
            R = None
            t = np.zeros(3)
    return tuple(links)


def _cleaned(x: Array) -> Array:
    """Return x with what rounding leaves of zeros put right."""
    return np.where(np.abs(x) < TINY, 0.0, x)


def _mass_matrices(links: Sequence[Link], cos: Array, sin: Array) -> Array:
    """Return M, (n, n, count): composite bodies, from the tip inwards."""
    n, count = cos.shape
    M = np.empty((n, n, count))
    body = _Body()
    wrenches: list[tuple[Vector, Vector]] = []  # this joint's and those further out
    for row in reversed(range(n)):
        link = links[row]
        k, i, j = link.axes
        body.add(link)
        h = body.h
        Q = body.Q
        moment: Vector = [0.0] * 3
        force: Vector = [0.0] * 3
        moment[k] = Q[i][i] + Q[j][j]
        moment[i] = -Q[i][k]
        moment[j] = -Q[j][k]
        force[i] = -h[j]
        force[j] = h[i]
        wrenches.insert(0, (moment, force))
        for column, (felt, _) in enumerate(wrenches, start=row):
            sign = link.sign * links[column].sign
            np.multiply(felt[k], sign, out=M[row, column])
        M[row, row] += link.armature
        M[row:, row] = M[row, row:]
        if row:
            c, s = cos[row], sin[row]
            body.to_parent(link, c, s)
            wrenches = [link.to_parent(c, s, *wrench) for wrench in wrenches]
    return M


class _Body:
    """The bodies distal to a joint as one body: m, h and Q about the frame's origin."""

    def __init__(self) -> None:
        self.m = 0.0
        self.h: Vector = [0.0] * 3
        self.Q: list[Vector] = [[0.0] * 3 for _ in range(3)]

    def add(self, link: Link) -> None:
        """Add a link's own, seen from its frame."""
        self.m += link.m
        for a in range(3):
            self.h[a] = self.h[a] + link.h[a]
            for b in range(a, 3):
                self.Q[a][b] = self.Q[b][a] = self.Q[a][b] + link.Q[a, b]

    def to_parent(self, link: Link, c: Array, s: Array) -> None:
        """See it from the frame of the link before: turn, then move by t."""
        k, i, j = link.axes
        m = self.m
        h = self.h
        Q = self.Q
        t = link.t
        mean = 0.5 * (Q[i][i] + Q[j][j])
        half = 0.5 * (Q[i][i] - Q[j][j])
        c2 = 1.0 - 2.0 * s * s  # cosine of the doubled angle, like s2
        s2 = 2.0 * s * c
        half, cross = half * c2 - Q[i][j] * s2, half * s2 + Q[i][j] * c2
        Q[i][i] = mean + half
        Q[j][j] = mean - half
        Q[i][j] = cross
        Q[i][k], Q[j][k] = turned(Q[i][k], Q[j][k], c, s)
        Q[j][i], Q[k][i], Q[k][j] = Q[i][j], Q[i][k], Q[j][k]
        h[i], h[j] = turned(h[i], h[j], c, s)
        if link.R is not None:
            h[:] = combined(link.R, h)
            self.Q = Q = _both_sides(link.R, Q)
        for a in np.flatnonzero(t).tolist():  # one after the other: moves add up
            for b in range(3):
                Q[a][b] = Q[b][a] = Q[a][b] + t[a] * h[b] * (1.0 + (a == b))
            Q[a][a] = Q[a][a] + m * t[a] * t[a]
            h[a] = h[a] + m * t[a]


def _both_sides(R: Array, Q: list[Vector]) -> list[Vector]:
    """Return R Q R^T."""
    QR = [combined(R, row) for row in Q]  # Q is symmetric: row i of Q R^T
    columns = [combined(R, [QR[a][b] for a in range(3)]) for b in range(3)]
    return [[columns[b][a] for b in range(3)] for a in range(3)]


def _torques(
    down: Vector, links: Sequence[Link], cos: Array, sin: Array, qd: Array, qdd: Array
) -> Array:
    """Return the torques, (n, count): the links' wrenches added up from the tip."""
    wrenches = _wrenches(down, links, cos, sin, qd, qdd)
    tau = np.empty_like(qd)
    f: Vector = [0.0] * 3
    n: Vector = [0.0] * 3
    for row in reversed(range(len(tau))):
        link = links[row]
        own_n, own_f = wrenches[row]
        n, f = plus(n, own_n), plus(f, own_f)
        np.multiply(n[link.k], link.sign, out=tau[row])
        n, f = link.to_parent(cos[row], sin[row], n, f)
    return tau


def _wrenches(
    down: Vector, links: Sequence[Link], cos: Array, sin: Array, qd: Array, qdd: Array
) -> list[tuple[Vector, Vector]]:
    """Return what each link's motion takes: velocities added up from the base."""
    wrenches = []
    w: Vector = [0.0] * 3
    alpha: Vector = [0.0] * 3
    a: Vector = [-x for x in down]  # a base that feels like gravity
    B: list[Vector] = [[0.0] * 3 for _ in range(3)]
    for row, link in enumerate(links):
        k, i, j = link.axes
        a = plus(a, combined(B, link.t))
        for v in (w, alpha, a):
            if link.R is not None:
                v[:] = combined(link.R.T, v)
            v[i], v[j] = turned(v[i], v[j], cos[row], -sin[row])
        alpha[i] = alpha[i] + w[j] * qd[row]
        alpha[j] = alpha[j] - w[i] * qd[row]
        alpha[k] = alpha[k] + qdd[row]
        w[k] = w[k] + qd[row]
        B = _point_accelerations(w, alpha)
        wrenches.append(_wrench(link, a, B))
    return wrenches


def _point_accelerations(w: Vector, alpha: Vector) -> list[Vector]:
    """Return B = [alpha] + [omega]^2, 3 x 3."""
    xx, yy, zz = (x * x for x in w)
    xy = w[0] * w[1]
    xz = w[0] * w[2]
    yz = w[1] * w[2]
    return [
        [-yy - zz, xy - alpha[2], xz + alpha[1]],
        [xy + alpha[2], -xx - zz, yz - alpha[0]],
        [xz - alpha[1], yz + alpha[0], -xx - yy],
    ]


def _wrench(link: Link, a: Vector, B: list[Vector]) -> tuple[Vector, Vector]:
    """Return (moment, force) that accelerate a link so, about its frame's origin."""
    f = plus([link.m * x for x in a], combined(B, link.h))
    n = cross(link.h, a)
    for x in range(3):  # n_x = the integral of r_y (B r)_z - r_z (B r)_y
        y, z = (x + 1) % 3, (x + 2) % 3
        n[x] = n[x] + dot(link.Q[y], B[z]) - dot(link.Q[z], B[y])
    return n, f

"""Dynamics of one arm at many configurations at once, in pure NumPy.

`robo47.dynamics` multiplies 6x6 matrices that are mostly zeros. Here the same
quantities go from link to link as single components, each an array over a chunk of
configurations that fits the processor's cache; `robo47.fast.links` chooses the links'
frames such that a hinge turns two components and leaves the third alone.

- `mass_matrix`: composite bodies, from the tip inwards (Featherstone, *Rigid Body
  Dynamics Algorithms*, section 6.2).
- `inverse_dynamics`: recursive Newton-Euler, outwards and back (section 5.3). The
  point r of a link accelerates by a + B r, with B = [alpha] + [omega]^2.
- `site_jacobian`: every axis and the arm's end, in world axes.

Conventions as in `robo47.dynamics`; m, h and Q are the integrals of 1, r and r r^T over
a link's mass. Units: radians, metres, kilograms, N m.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.arm import Arm
from robo47.checks import Array
from robo47.fast.chains import chunk_of
from robo47.fast.links import Link, Links, links_of
from robo47.fast.mass_matrix import mass_matrices
from robo47.fast.vectors import Vector, combined, cross, dot, plus, turned

CHUNK = 4096  # fewer, and Python's own time shows; more, and they leave the cache


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
    links, n = links_of(arm), len(arm.masses)
    return _in_chunks(lambda *args: mass_matrices(links, *args), links, (n, n), q)


def inverse_dynamics(arm: Arm, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> Array:
    """Return the torque for an acceleration, without armature and damping.

    Args:
        arm: of hinges.
        q: configurations, rad, (..., n).
        qd: joint velocities, rad/s, (..., n).
        qdd: joint accelerations, rad/s^2, (..., n).

    Returns:
        Torque, N m, (..., n).

    Raises:
        ValueError: as `mass_matrix`.
    """
    links, n = links_of(arm), len(arm.masses)
    return _in_chunks(lambda *args: _torques(links, *args), links, (n,), q, qd, qdd)


def site_jacobian(arm: Arm, q: ArrayLike) -> Array:
    """Return the Jacobian of the arm's end: (omega; v of its origin), world axes.

    Args:
        arm: of hinges.
        q: configurations, rad, (..., n).

    Returns:
        J_site, (..., 6, n).

    Raises:
        ValueError: as `mass_matrix`.
    """
    links, n = links_of(arm), len(arm.masses)
    return _in_chunks(lambda *args: _jacobians(links, *args), links, (6, n), q)


def _in_chunks(
    work: Callable[..., Array], links: Links, shape: tuple[int, ...], *given: ArrayLike
) -> Array:
    """Return what work(cos, sin, ...) returns, chunk by chunk; sin has the sign."""
    n = len(links.links)
    names = ("q", "qd", "qdd")
    rows = [checks.array(x, name, (n,)) for x, name in zip(given, names, strict=False)]
    rows = list(np.broadcast_arrays(*rows))
    batch = rows[0].shape[:-1]
    flat = [row.reshape(-1, n) for row in rows]
    out = np.empty((math.prod(batch), math.prod(shape)))
    signs = np.array([[link.sign] for link in links.links])
    for start in range(0, len(out), CHUNK):
        part = slice(start, start + CHUNK)
        q, *more = (np.ascontiguousarray(row[part].T) for row in flat)
        chunk = chunk_of(q)
        found = work(chunk.cos, chunk.sin * signs, *(row * signs for row in more))
        out[part] = found.reshape(out.shape[1], -1).T
    return out.reshape(*batch, *shape)


def _torques(links: Links, cos: Array, sin: Array, qd: Array, qdd: Array) -> Array:
    """Return the torques, (n, count): the links' wrenches added up from the tip."""
    wrenches = _wrenches(links, cos, sin, qd, qdd)
    tau = np.empty_like(qd)
    f: Vector = [0.0] * 3
    n: Vector = [0.0] * 3
    for row in reversed(range(len(tau))):
        link = links.links[row]
        k, i, j = link.axes
        own_n, own_f = wrenches[row]
        n, f = plus(n, own_n), plus(f, own_f)
        np.multiply(n[k], link.sign, out=tau[row])
        for v in (n, f):
            v[i], v[j] = turned(v[i], v[j], cos[row], sin[row])
            if link.R is not None:
                v[:] = combined(link.R, v)
        n = plus(n, cross(link.t, f))
    return tau


def _wrenches(
    links: Links, cos: Array, sin: Array, qd: Array, qdd: Array
) -> list[tuple[Vector, Vector]]:
    """Return what each link's motion takes: velocities added up from the base."""
    wrenches = []
    w: Vector = [0.0] * 3
    alpha: Vector = [0.0] * 3
    a: Vector = [-float(x) for x in links.gravity]  # a base that feels like gravity
    B: list[Vector] = [[0.0] * 3 for _ in range(3)]
    for row, link in enumerate(links.links):
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
    xy, xz, yz = w[0] * w[1], w[0] * w[2], w[1] * w[2]
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


def _jacobians(links: Links, cos: Array, sin: Array) -> Array:
    """Return J_site, (6, n, count): axes and origins in the world, then the end."""
    n, count = cos.shape
    J = np.empty((6, n, count))
    columns: list[Vector] = [list(row) for row in np.eye(3)]  # the frame's own axes
    p: Vector = [0.0] * 3
    for row, link in enumerate(links.links):
        k, i, j = link.axes
        p = _moved(p, columns, link.t)
        if link.R is not None:
            columns = [_moved([0.0] * 3, columns, along) for along in link.R.T]
        for a in range(3):
            np.multiply(columns[k][a], link.sign, out=J[a, row])
            J[3 + a, row] = p[a]
        x, y = columns[i], columns[j]
        pairs = [turned(x[a], y[a], cos[row], -sin[row]) for a in range(3)]
        columns[i], columns[j] = [u for u, _ in pairs], [v for _, v in pairs]
    end = _moved(p, columns, links.t_end)
    x, y, z = (end[a] - J[3 + a] for a in range(3))  # from each axis to the end
    for a, (v, u) in enumerate(((z, y), (x, z), (y, x))):
        b, d = (a + 1) % 3, (a + 2) % 3
        J[3 + a] = J[b] * v - J[d] * u
    return J


def _moved(p: Vector, columns: list[Vector], along: Array) -> Vector:
    """Return p + the sum of along times the columns."""
    return [p[a] + dot(along, [column[a] for column in columns]) for a in range(3)]

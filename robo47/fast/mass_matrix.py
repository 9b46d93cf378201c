"""Mass matrices of one arm at many configurations: the method of composite bodies.

From the tip inwards, all links that a joint carries become one body. What a unit
acceleration of the joint makes of it is a wrench, and what each joint further in feels
of that wrench is an entry of M (Featherstone, *Rigid Body Dynamics Algorithms*, section
6.2). A body is m, h and Q: the integrals of 1, r and r r^T over its mass, which a turn
and a move change in few operations. Units: metres, kilograms.
"""

from collections.abc import Sequence

import numpy as np

from robo47.checks import Array
from robo47.fast.links import Link
from robo47.fast.vectors import Vector, combined, turned


def mass_matrices(links: Sequence[Link], cos: Array, sin: Array) -> Array:
    """Return M, (n, n, count): composite bodies, from the tip inwards."""
    n, count = cos.shape
    M, body = np.empty((n, n, count)), Body()
    wrenches: list[tuple[Vector, Vector]] = []  # this joint's and those further out
    for row in reversed(range(n)):
        link = links[row]
        k, i, j = link.axes
        body.add(link)
        h, Q = body.h, body.Q
        moment: Vector = [0.0] * 3
        force: Vector = [0.0] * 3
        moment[k], moment[i], moment[j] = Q[i][i] + Q[j][j], -Q[i][k], -Q[j][k]
        force[i], force[j] = -h[j], h[i]
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


class Body:
    """What hangs on a joint, as one body: m, h and Q about the frame's origin."""

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
        m, h, Q, t = self.m, self.h, self.Q, link.t
        mean, half = 0.5 * (Q[i][i] + Q[j][j]), 0.5 * (Q[i][i] - Q[j][j])
        c2, s2 = 1.0 - 2.0 * s * s, 2.0 * s * c  # of twice the angle
        half, cross = half * c2 - Q[i][j] * s2, half * s2 + Q[i][j] * c2
        Q[i][i], Q[j][j], Q[i][j] = mean + half, mean - half, cross
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

"""The elementary moves that every chain is made of, on one frame or on many at once.

A frame is its axes x, y, z and its origin p, each three components: floats for one
configuration, arrays (n,) for a batch. Both use the same arithmetic. A rotation about
one of the frame's own axes touches only the two other axes: about z,
x' = c x + s y and y' = c y - s x. A slide touches only p.

Units: metres and radians; quaternions (w, x, y, z).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.fast.vectors import Number, Numbers

Triple = tuple[Number, Number, Number]
Axes = Sequence[Triple]  # x, y, z, p
Terms = list[tuple[int, float]]  # (which axis, its weight), without zeros

ZERO: Triple = (0.0, 0.0, 0.0)
WORLD: Axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), ZERO)


class Chunk(NamedTuple):
    """One configuration or a batch: a float, or an array (n,), per number in qpos.

    `q` is measured from the joint's reference; `cos` and `sin` are of q, for hinges.
    """

    q: Numbers
    cos: Numbers
    sin: Numbers


class Shift:
    """Move the origin by a fixed vector, in the frame's own axes, metres."""

    def __init__(self, vector: Array) -> None:
        self.vector = vector
        self._terms = terms_of(vector)

    def move(self, at: Axes, chunk: Chunk) -> Axes:
        x, y, z, p = at
        return x, y, z, moved(p, combine(at, self._terms))


class Rotate:
    """Turn the frame by a fixed rotation, (3, 3)."""

    def __init__(self, R: Array) -> None:
        self.R = R
        self._terms = [terms_of(column) for column in R.T]

    def move(self, at: Axes, chunk: Chunk) -> Axes:
        x, y, z = self._terms
        return combine(at, x), combine(at, y), combine(at, z), at[3]


class Turn:
    """Hinge: rotate by q about the frame's axis k, or about minus that axis."""

    def __init__(self, k: int, sign: float, adr: int) -> None:
        self.k = k
        self.sign = sign
        self.adr = adr
        one, two = (k + 1) % 3, (k + 2) % 3
        # A turn about -k is a turn about k with the other two axes swapped.
        # the first axis turns towards the second
        self._turned = (one, two) if sign > 0 else (two, one)

    def move(self, at: Axes, chunk: Chunk) -> Axes:
        i, j = self._turned
        _, cos, sin = chunk
        c, s = cos[self.adr], sin[self.adr]
        x, y, z = at[i]
        u, v, w = at[j]
        axes = list(at)
        axes[i] = c * x + s * u, c * y + s * v, c * z + s * w
        axes[j] = c * u - s * x, c * v - s * y, c * w - s * z
        return axes


class Slide:
    """Slide: move the origin by q along a fixed direction of the frame."""

    def __init__(self, direction: Array, adr: int) -> None:
        self.adr = adr
        self._terms = terms_of(direction)

    def along(self, at: Axes) -> Triple:
        """Return where q = 1 would move the origin, in world axes."""
        return combine(at, self._terms)

    def move(self, at: Axes, chunk: Chunk) -> Axes:
        x, y, z = self.along(at)
        q = chunk.q[self.adr]
        return (*at[:3], moved(at[3], (x * q, y * q, z * q)))


class Ball:
    """Ball joint: rotate by the quaternion in q."""

    def __init__(self, name: str, adr: int) -> None:
        self.name = name
        self.adr = adr

    def move(self, at: Axes, chunk: Chunk) -> Axes:
        try:
            R = se3.quat_to_R(np.array(chunk.q[self.adr : self.adr + 4]).T)
        except ValueError:
            raise ValueError(
                f"{self.name}: its quaternion in qpos has length 0"
            ) from None
        x, y, z = (
            tuple(a * u + b * v + c * w for a, b, c in zip(*at[:3], strict=True))
            for u, v, w in np.moveaxis(R, (-1, -2), (0, 1))
        )
        return x, y, z, at[3]


Step = Shift | Rotate | Turn | Slide | Ball  # each takes a frame to the next one


def combine(at: Axes, terms: Terms) -> Triple:
    """Return the sum of weight times axis, without copies of what is there."""
    total = None
    for axis, weight in terms:
        x, y, z = at[axis]
        if weight != 1.0:
            x, y, z = weight * x, weight * y, weight * z
        total = (x, y, z) if total is None else moved(total, (x, y, z))
    return total or ZERO


def moved(p: Triple, by: Triple) -> Triple:
    """Return the sum of two triples."""
    x, y, z = p
    u, v, w = by
    return x + u, y + v, z + w


def terms_of(weights: Array) -> Terms:
    """Return fixed weights of the axes, (3,), as terms."""
    return [(i, w) for i, w in enumerate(weights.tolist()) if w != 0.0]

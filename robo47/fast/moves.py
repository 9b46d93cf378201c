"""The elementary moves that every chain is made of, on many frames at once.

A batch of frames is four columns: the axes x, y, z and the origin p, each a (3, n)
array whose entry [0, i] is the world x coordinate in configuration i. A turn about
one of the frame's own axes touches only the two other columns: about z,
x' = c x + s y and y' = c y - s x. A slide touches only p.

Units: metres and radians; quaternions (w, x, y, z).
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from robo47 import se3
from robo47.checks import Array


class Columns(NamedTuple):
    """A batch of frames: axes x, y, z and origin p, each (3, n), or (3, 1) for all."""

    x: Array
    y: Array
    z: Array
    p: Array


_EX, _EY, _EZ = np.eye(3)[:, :, None]
WORLD = Columns(_EX, _EY, _EZ, np.zeros((3, 1)))


class Chunk(NamedTuple):
    """A batch of configurations, one row per number in qpos: each (nq, n).

    `q` is measured from the joint's reference; `cos` and `sin` are of q, for hinges.
    """

    q: Array
    cos: Array
    sin: Array


class Step(Protocol):
    """An elementary move: takes the frame before it to the one after it."""

    def __call__(self, at: Columns, chunk: Chunk) -> Columns: ...


@dataclass(frozen=True)
class Shift:
    """Move the origin by a fixed vector, in the frame's own axes, metres."""

    vector: Array

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        return at._replace(p=at.p + combine(at, self.vector))


@dataclass(frozen=True)
class Rotate:
    """Turn the frame by a fixed rotation, (3, 3)."""

    R: Array

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        x, y, z = (combine(at, weights) for weights in self.R.T)
        return Columns(x, y, z, at.p)


@dataclass(frozen=True)
class Turn:
    """Hinge: turn by q about the frame's axis k, or about minus that axis."""

    k: int
    sign: float
    adr: int

    @property
    def turned(self) -> tuple[int, int]:
        """The axes that it turns: i towards j."""
        one, two = (self.k + 1) % 3, (self.k + 2) % 3
        # A turn about -k is a turn about k with the other two axes swapped.
        return (one, two) if self.sign > 0 else (two, one)

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        c, s = chunk.cos[self.adr], chunk.sin[self.adr]
        axes = list(at)
        i, j = self.turned
        axes[i], axes[j] = c * at[i] + s * at[j], c * at[j] - s * at[i]
        return Columns(*axes)


@dataclass(frozen=True)
class Slide:
    """Slide: move the origin by q along a fixed direction of the frame."""

    direction: Array
    adr: int

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        return at._replace(p=at.p + combine(at, self.direction) * chunk.q[self.adr])


@dataclass(frozen=True)
class Ball:
    """Ball: turn by the quaternion in q."""

    name: str
    adr: int

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        R = np.moveaxis(_rotation(chunk.q, self.adr, self.name), 0, -1)
        x, y, z = (at.x * R[0, j] + at.y * R[1, j] + at.z * R[2, j] for j in range(3))
        return Columns(x, y, z, at.p)


@dataclass(frozen=True)
class Free:
    """Free: the pose (position, quaternion) in q, whatever the frame was."""

    name: str
    adr: int

    def __call__(self, at: Columns, chunk: Chunk) -> Columns:
        x, y, z = np.moveaxis(
            _rotation(chunk.q, self.adr + 3, self.name), (2, 1), (0, 1)
        )
        return Columns(x, y, z, chunk.q[self.adr : self.adr + 3])


def combine(at: Columns, weights: Array) -> Array:
    """Return the sum of weight times axis, skipping zeros and plain copies.

    Args:
        at: the frame whose axes are added.
        weights: (3,).
    """
    terms = [
        axis if weight == 1.0 else axis * weight
        for axis, weight in zip(at[:3], weights, strict=True)
        if weight != 0.0
    ]
    return sum(terms[1:], start=terms[0]) if terms else np.zeros((3, 1))


def _rotation(q: Array, adr: int, name: str) -> Array:
    """Return R, (n, 3, 3), of the quaternions at adr; joints named in the error."""
    try:
        return se3.quat_to_R(q[adr : adr + 4].T)
    except ValueError:
        raise ValueError(f"{name}: its quaternion in qpos has length 0") from None

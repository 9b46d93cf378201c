"""The chain's product for one configuration, in plain Python floats.

For a single configuration NumPy spends its time on calls, not on numbers: twelve steps
of `moves` take it 60 us, and plain floats a fifth of that. The steps are the same; a
frame is (x, y, z, p), each a tuple of three floats.

Units: metres and radians.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from robo47.checks import Array
from robo47.fast.moves import Rotate, Shift, Slide, Step, Turn

Floats = tuple[float, ...]
Axes = Sequence[Floats]  # x, y, z, p
Terms = list[tuple[int, float]]  # (which axis, its weight), without zeros

WORLD: Axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


class Single:
    """A plan's steps and frames for one configuration at a time."""

    def __init__(
        self,
        steps: Sequence[tuple[int, Step]],
        frames: Iterable[tuple[int, Array, Array]],
    ) -> None:
        self._steps = [(source, *_parts(step)) for source, step in steps]
        self._frames = [
            (node, [_terms(column) for column in R.T], _terms(t))
            for node, R, t in frames
        ]
        self._turns: dict[int, tuple[int, int, float]] = {}
        self._slides: dict[int, tuple[int, Terms]] = {}
        for node, (_, step) in enumerate(steps, start=1):
            if isinstance(step, Turn):
                self._turns[step.adr] = node, step.k, step.sign
            elif isinstance(step, Slide):
                self._slides[step.adr] = node, _terms(step.direction)

    def poses(self, q: list[float]) -> list[Array]:
        """Return each frame's pose, (4, 4).

        Args:
            q: finite configuration, measured from the joints' references.
        """
        nodes = self._nodes(q)
        return [_pose(nodes[node], columns, t) for node, columns, t in self._frames]

    def jacobian(self, q: list[float], at_end: bool) -> tuple[list[Floats], Axes]:
        """Return a Jacobian of the only frame, and the frame.

        Args:
            q: as above, of a chain without branches.
            at_end: as in `jacobians.jacobian_columns`.

        Returns:
            The Jacobian's columns, (omega; v) in world axes, and the frame.
        """
        nodes, ((node, columns, t),) = self._nodes(q), self._frames
        end = [_added(WORLD[3], nodes[node], terms) for terms in columns]
        p = _added(nodes[node][3], nodes[node], t)
        x, y, z = p if at_end else WORLD[3]
        J: list[Floats] = []
        for adr in range(len(q)):
            a = b = c = u = v = w = 0.0
            if adr in self._turns:
                at, k, sign = self._turns[adr]
                (a, b, c), (u, v, w) = nodes[at][k], nodes[at][3]
                a, b, c, u, v, w = sign * a, sign * b, sign * c, x - u, y - v, z - w
                u, v, w = b * w - c * v, c * u - a * w, a * v - b * u
            if adr in self._slides:
                at, terms = self._slides[adr]
                u, v, w = _added((u, v, w), nodes[at], terms)
            J.append((a, b, c, u, v, w))
        return J, [*end, p]

    def _nodes(self, q: list[float]) -> list[Axes]:
        nodes = [WORLD]
        for source, kind, adr, parts in self._steps:
            at = nodes[source]
            if kind is Turn:
                i, j = parts
                c, s = math.cos(q[adr]), math.sin(q[adr])
                (a, b, d), (e, f, g) = at[i], at[j]
                axes = list(at)
                axes[i] = (c * a + s * e, c * b + s * f, c * d + s * g)
                axes[j] = (c * e - s * a, c * f - s * b, c * g - s * d)
            elif kind is Rotate:
                axes = [*(_added(WORLD[3], at, terms) for terms in parts), at[3]]
            elif kind is Slide:
                along = [(axis, weight * q[adr]) for axis, weight in parts]
                axes = [*at[:3], _added(at[3], at, along)]
            else:
                axes = [*at[:3], _added(at[3], at, parts)]
            nodes.append(axes)
        return nodes


def single_of(
    steps: Sequence[tuple[int, Step]], frames: Iterable[tuple[int, Array, Array]]
) -> Single | None:
    """Return the plan for one configuration; None where a joint is a ball or free."""
    if all(isinstance(step, Turn | Shift | Slide | Rotate) for _, step in steps):
        return Single(steps, frames)
    return None


def _parts(step: Step) -> tuple[type, int, Any]:
    """Return what a step is, which joint's, and its numbers."""
    if isinstance(step, Turn):
        return Turn, step.adr, step.turned
    if isinstance(step, Rotate):
        return Rotate, -1, [_terms(column) for column in step.R.T]
    if isinstance(step, Slide):
        return Slide, step.adr, _terms(step.direction)
    assert isinstance(step, Shift)
    return Shift, -1, _terms(step.vector)


def _terms(weights: Array) -> Terms:
    return [(i, w) for i, w in enumerate(weights.tolist()) if w != 0.0]


def _added(p: Floats, at: Axes, terms: Terms) -> Floats:
    """Return p and the sum of weight times axis."""
    x, y, z = p
    for axis, weight in terms:
        a, b, c = at[axis]
        x += weight * a
        y += weight * b
        z += weight * c
    return x, y, z


def _pose(at: Axes, columns: list[Terms], t: Terms) -> Array:
    """Return the pose of a frame that is fixed to a node."""
    (a, d, g), (b, e, h), (c, f, i) = (_added(WORLD[3], at, w) for w in columns)
    x, y, z = _added(at[3], at, t)
    rows = [a, b, c, x, d, e, f, y, g, h, i, z, 0.0, 0.0, 0.0, 1.0]
    return np.array(rows).reshape(4, 4)

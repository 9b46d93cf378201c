"""The product of exponentials for many configurations at once, in pure NumPy.

e^[S] q is a move to the screw's line, a turn by q (a slide along the line by pitch
times q) and the move back. So a product of exponentials is a chain of the elementary
moves of `robo47.moves`, and what `robo47.batch` does for chains of links serves here:
the two moves between neighbouring joints become one, and turns about an axis of the
moving frame cost a tenth of a 4x4 product.

Everything here works on columns: n configurations are (joints, n), and a batch of
vectors is (3, n). Units: metres, radians; screws are (omega; v).
"""

import functools
from typing import NamedTuple

import numpy as np

from robo47.batch import ROUNDING, Cursor, Plan, chunk_of, evaluate, rounded
from robo47.checks import Array
from robo47.moves import WORLD, Columns, combine

END = "end"


class Axis(NamedTuple):
    """Where a joint's screw is, seen from the frame that `node` of a plan moves.

    `direction` is omega, or v of a slide; `point` is on the line; `pitch` is the
    metres along it per radian, None for a slide.
    """

    node: int
    direction: Array
    point: Array
    pitch: float | None


class Arm(NamedTuple):
    """A plan that ends at the end effector, and the axes of its joints."""

    plan: Plan
    axes: tuple[Axis, ...]


def arm_of(screws: Array, M: Array) -> Arm:
    """Return the moves of e^[S1] q1 ... e^[Sn] qn M, worked out once for each arm.

    Args:
        screws: checked space screws, (n, 6).
        M: `T_world_ee` at q = 0, (4, 4).
    """
    return _arm_of(screws.tobytes(), M.tobytes())


def end_poses(arm: Arm, q: Array) -> Array:
    """Return `T_world_ee`, (..., 4, 4), at configurations q, (..., n)."""
    return evaluate(arm.plan, q)[END]


def columns(arm: Arm, q: Array) -> tuple[Array, Array, Array]:
    """Return where the screws and the end effector are, for one chunk of q.

    Args:
        arm: from `arm_of`.
        q: finite configurations, (joints, n); n is best at most `batch.CHUNK`.

    Returns:
        The screws' directions and moments, (6, joints, n): the space Jacobian; the
        end's rotation (3, 3, n) and position (3, n).
    """
    chunk, nodes = chunk_of(q), [WORLD]
    for source, step in arm.plan.steps:
        nodes.append(step(nodes[source], chunk))
    J = np.empty((6, len(arm.axes), q.shape[1]))
    for i, axis in enumerate(arm.axes):
        _write_column(J[:, i], nodes[axis.node], axis)
    end = arm.plan.frames[END]
    at, R = nodes[end.node], np.empty((3, 3, q.shape[1]))
    for j, weights in enumerate(end.R.T):
        R[:, j] = combine(at, weights)
    return J, R, at.p + combine(at, end.t)


def _write_column(column: Array, at: Columns, axis: Axis) -> None:
    """Write one screw as it stands now, (6, n): omega; v = p x omega + pitch omega."""
    direction = combine(at, axis.direction)
    if axis.pitch is None:
        column[:3], column[3:] = 0.0, direction
        return
    x, y, z = at.p + combine(at, axis.point)
    column[:3] = direction
    a, b, c = column[:3]
    column[3], column[4], column[5] = y * c - z * b, z * a - x * c, x * b - y * a
    if axis.pitch:
        column[3:] += axis.pitch * direction


@functools.lru_cache(maxsize=64)
def _arm_of(screws: bytes, M: bytes) -> Arm:
    S = np.frombuffer(screws).reshape(-1, 6)
    plan, axes = Plan(len(S)), []
    cursor = Cursor(plan)
    for i, (omega, v) in enumerate(zip(S[:, :3], S[:, 3:], strict=True)):
        axes.append(_add(cursor, i, omega, v))
    cursor.fixed(np.frombuffer(M).reshape(4, 4))
    cursor.mark(END)
    return Arm(plan, tuple(axes))


def _add(cursor: Cursor, i: int, omega: Array, v: Array) -> Axis:
    """Add e^[S] q_i, with S = (omega; v), and return where its axis is."""
    if omega @ omega < 0.5:  # 0, a slide; the other lengths were refused
        cursor.slide(v, i, 0.0)
        return Axis(cursor.node, cursor.R @ v, cursor.t, None)
    point, pitch = np.cross(omega, v), float(omega @ v)
    cursor.shift(point)
    cursor.turn(omega, i, 0.0)
    axis = Axis(cursor.node, rounded(cursor.R @ omega), cursor.t, pitch)
    cursor.shift(-point)
    if abs(pitch) <= ROUNDING * max(1.0, float(np.abs(v).max())):
        return axis._replace(pitch=0.0)
    cursor.slide(pitch * omega, i, 0.0)
    return axis

"""The product of exponentials for many configurations at once, in pure NumPy.

Two ways, both for the n columns of a batch q, (joints, n):

- `end_poses`, when only the end matters. e^[S] q is a move to the screw's line, a turn
  by q (a slide along the line by pitch times q) and the move back. So the product is a
  chain of the elementary moves of `robo47.moves`, which `robo47.batch` works through:
  the two moves between neighbouring joints become one, and a turn about an axis of
  the moving frame costs a tenth of a 4x4 product.
- `jacobian_columns`, when every joint matters. Each joint gets a frame of its own whose
  z axis is the screw's line: then e^[S1] q1 ... is G1 Rz(q1) G2 Rz(q2) ..., with fixed
  G, and the joint's axis is just the third column of its frame, wherever the arm is.

Units: metres, radians; screws are (omega; v).
"""

import functools
from typing import NamedTuple

import numpy as np

from robo47 import se3
from robo47.batch import ROUNDING, Cursor, Plan, chunk_of, evaluate, frame_with_z
from robo47.checks import Array

END = "end"


class Line(NamedTuple):
    """A screw as a line in space.

    Attributes:
        turns: 1.0 for a hinge, 0.0 for a slide.
        direction: unit vector along the line, (3,).
        point: the point of the line that is nearest to the origin, metres, (3,).
        pitch: metres along the line for each radian; for a slide, for each metre of q.
    """

    turns: float
    direction: Array
    point: Array
    pitch: float


class Arm(NamedTuple):
    """An arm's fixed frames.

    Attributes:
        offsets: the joints' frames, each seen from the one before, and the end's,
            (joints + 1, 4, 4).
        turns: of `Line`, (joints, 1).
        pitch: of `Line`, (joints, 1).
    """

    offsets: Array
    turns: Array
    pitch: Array


def end_poses(screws: Array, M: Array, q: Array) -> Array:
    """Return `T_world_ee`, (..., 4, 4), at q, (..., joints), of one arm.

    Args:
        screws: checked space screws, (joints, 6).
        M: checked `T_world_ee` at q = 0, (4, 4).
        q: finite configurations.
    """
    return evaluate(_plan(screws.tobytes(), M.tobytes()), q)[END]


def arm_of(screws: Array, M: Array) -> Arm:
    """Return the fixed frames of one arm, worked out once; arguments as above."""
    return _arm(screws.tobytes(), M.tobytes())


def jacobian_columns(arm: Arm, q: Array, at_end: bool) -> tuple[Array, Array, Array]:
    """Return the Jacobian, and where the end effector is.

    Args:
        arm: from `arm_of`.
        q: finite configurations, (joints, n); n of about 1000 serves the cache best.
        at_end: False for the velocity of the point at the origin (the space Jacobian),
            True for that of the end effector, in world axes.

    Returns:
        J, (6, joints, n); the end's rotation, (3, 3, n), and position, (3, n).
    """
    W = _joint_frames(arm, q)
    end = np.einsum("ikn,kj->ijn", W[-1, :, :3], arm.offsets[-1, :3])
    end[:, 3] += W[-1, :, 3]
    J = np.empty((6, *q.shape))
    J[:3] = np.moveaxis(W[:, :, 2], 1, 0)
    (a, b, c), (x, y, z) = J[:3], np.moveaxis(W[:, :, 3], 1, 0)
    if at_end:
        x, y, z = x - end[0, 3], y - end[1, 3], z - end[2, 3]
    # v = point x omega, written out: np.cross takes ten times as long.
    J[3], J[4], J[5] = y * c - z * b, z * a - x * c, x * b - y * a
    if arm.pitch.any() or not arm.turns.all():
        J[3:] = J[3:] * arm.turns + J[:3] * arm.pitch
        J[:3] *= arm.turns
    return J, end[:, :3], end[:, 3]


def _joint_frames(arm: Arm, q: Array) -> Array:
    """Return the joints' frames, (joints, 3, 4, n): column 2 the axis, 3 a point."""
    turn = chunk_of(q * arm.turns)
    c, s = turn.cos[:, None], turn.sin[:, None]
    G = arm.offsets[:-1, :3, :, None]
    local = np.empty((*G.shape[:3], q.shape[1]))
    local[:, :, 0] = G[:, :, 0] * c + G[:, :, 1] * s
    local[:, :, 1] = G[:, :, 1] * c - G[:, :, 0] * s
    local[:, :, 2] = G[:, :, 2]
    local[:, :, 3] = G[:, :, 3] + G[:, :, 2] * (arm.pitch * q)[:, None]
    W = np.empty_like(local)
    W[0] = local[0]
    for i in range(1, len(W)):
        np.einsum("ikn,kjn->ijn", W[i - 1, :, :3], local[i], out=W[i])
        W[i, :, 3] += W[i - 1, :, 3]
    return W


@functools.lru_cache(maxsize=64)
def _plan(screws: bytes, M: bytes) -> Plan:
    lines = _lines(screws)
    plan = Plan(len(lines))
    cursor = Cursor(plan)
    for i, line in enumerate(lines):
        if line.turns:
            cursor.shift(line.point)
            cursor.turn(line.direction, i, 0.0)
            cursor.shift(-line.point)
        if line.pitch:
            cursor.slide(line.pitch * line.direction, i, 0.0)
    cursor.fixed(np.frombuffer(M).reshape(4, 4))
    cursor.mark(END)
    return plan


@functools.lru_cache(maxsize=64)
def _arm(screws: bytes, M: bytes) -> Arm:
    lines = _lines(screws)
    frames = np.tile(
        np.eye(4), (len(lines) + 2, 1, 1)
    )  # the world, the joints, the end
    for T, line in zip(frames[1:-1], lines, strict=True):
        T[:3, :3], T[:3, 3] = frame_with_z(line.direction), line.point
    frames[-1] = np.frombuffer(M).reshape(4, 4)
    turns = np.array([[line.turns] for line in lines])
    pitch = np.array([[line.pitch] for line in lines])
    return Arm(se3.inverse(frames[:-1]) @ frames[1:], turns, pitch)


def _lines(screws: bytes) -> list[Line]:
    rows = np.frombuffer(screws).reshape(-1, 6)
    return [_line(omega, v) for omega, v in zip(rows[:, :3], rows[:, 3:], strict=True)]


def _line(omega: Array, v: Array) -> Line:
    if omega @ omega < 0.5:  # 0, a slide; other lengths than 0 and 1 were refused
        speed = float(np.linalg.norm(v))
        direction = v / speed if speed else np.array([0.0, 0.0, 1.0])
        return Line(0.0, direction, np.zeros(3), speed)
    pitch = float(omega @ v)
    if abs(pitch) <= ROUNDING * max(1.0, float(np.abs(v).max())):
        pitch = 0.0
    return Line(1.0, omega, np.cross(omega, v), pitch)

"""The product of exponentials for many configurations at once, in pure NumPy.

`end_poses` is for when only the end matters. e^[S] q is a move to the screw's line, a
turn by q (a slide along the line by pitch times q) and the move back. So the product is
a chain of the elementary moves of `robo47.fast.moves`, which `chains` works through:
the two moves between neighbouring joints become one, and a turn about an axis of the
moving frame costs a tenth of a 4x4 product.
`robo47.fast.jacobians` is for when every joint matters.

Units: metres, radians; screws are (omega; v).
"""

import functools
import math
from typing import NamedTuple

import numpy as np

from robo47 import checks
from robo47.checks import Array
from robo47.fast.chains import ROUNDING, Cursor, Plan, evaluate
from robo47.fast.one import Single

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


def end_poses(screws: Array, M: Array, q: Array) -> Array:
    """Return `T_world_ee`, (..., 4, 4), at q, (..., joints), of one arm.

    Args:
        screws: checked space screws, (joints, 6).
        M: checked `T_world_ee` at q = 0, (4, 4).
        q: finite configurations.
    """
    return evaluate(plan_of(screws, M), q)[END]


def plan_of(screws: Array, M: Array) -> Plan:
    """Return the chain of one arm, worked out once; arguments as above."""
    return _plan(screws.tobytes(), M.tobytes())


def chain_of(screws: Array, M: Array) -> Single:
    """Return the chain of one arm for one configuration at a time."""
    chain = plan_of(screws, M).single
    assert chain is not None  # hinges and slides alone
    return chain


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
            cursor.slide(line.direction, i, 0.0, line.pitch)
    cursor.fixed(np.frombuffer(M).reshape(4, 4))
    cursor.mark(END)
    return plan


def _lines(screws: bytes) -> list[Line]:
    rows = np.frombuffer(screws).reshape(-1, 6)
    return [_line(omega, v) for omega, v in zip(rows[:, :3], rows[:, 3:], strict=True)]


def _line(omega: Array, v: Array) -> Line:
    if omega @ omega < 0.5:  # 0, a slide; other lengths than 0 and 1 were refused
        direction = checks.unit(v, "v") if v.any() else np.array([0.0, 0.0, 1.0])
        return Line(0.0, direction, np.zeros(3), math.hypot(*v))
    pitch = float(omega @ v)
    if abs(pitch) <= ROUNDING * max(1.0, float(np.abs(v).max())):
        pitch = 0.0
    return Line(1.0, omega, np.cross(omega, v), pitch)

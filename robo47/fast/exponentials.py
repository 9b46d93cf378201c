"""The product of exponentials for many configurations at once, in pure NumPy.

e^[S] q is a move to the screw's line, a turn by q (a slide along the line by pitch
times q) and the move back. So the product is a chain of the elementary moves of
`robo47.fast.moves`, which `chains` works through: the two moves between neighbouring
joints become one, and a turn about an axis of the moving frame costs a tenth of a 4x4
product. `robo47.fast.jacobians` is for when every joint matters.

Units: metres, radians; screws are (omega; v).
"""

import functools
import math

import numpy as np

from robo47 import checks
from robo47.checks import Array
from robo47.fast.chains import ROUNDING, Cursor, Plan

END = "end"


def plan_of(screws: Array, M: Array) -> Plan:
    """Return the chain of one arm to its `END`, worked out once.

    Args:
        screws: checked space screws, (joints, 6).
        M: checked `T_world_ee` at q = 0, (4, 4).
    """
    return _plan(screws.tobytes(), M.tobytes())


@functools.lru_cache(maxsize=64)
def _plan(screws: bytes, M: bytes) -> Plan:
    rows = np.frombuffer(screws).reshape(-1, 2, 3)
    plan = Plan(len(rows))
    cursor = Cursor(plan)
    for i, (omega, v) in enumerate(rows):
        if omega @ omega < 0.5:  # 0, a slide; other lengths than 0 and 1 were refused
            if v.any():
                cursor.slide(checks.unit(v, "v"), i, 0.0, math.hypot(*v))
            continue
        point, pitch = np.cross(omega, v), float(omega @ v)  # nearest to the origin
        cursor.shift(point)
        cursor.turn(omega, i, 0.0)
        cursor.shift(-point)
        if abs(pitch) > ROUNDING * max(1.0, float(np.abs(v).max())):
            cursor.slide(omega, i, 0.0, pitch)
    cursor.fixed(np.frombuffer(M).reshape(4, 4))
    cursor.mark(END)
    return plan

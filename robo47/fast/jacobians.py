"""The Jacobians of one arm at one configuration or at many, in pure NumPy.

The plan of `robo47.fast.chains` turns a frame at each joint, about one of the
frame's own axes: where it stands, a Jacobian's column can be read off.

Units: metres, radians; screws are (omega; v).
"""

from typing import Any

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import END, Plan, chunk_of, in_chunks, one_of, plan_of, rows_of
from robo47.fast.moves import ZERO, Chunk, Slide, moved


def jacobians(screws: Array, M: Array, q: Array, at_end: bool) -> Array:
    """Return the Jacobian, (..., 6, joints), at finite q, (..., joints).

    The other arguments are as for `chains.plan_of` and `columns_of`.
    """
    plan = plan_of(screws, M)
    n = q.shape[-1]
    if q.size == n:
        J, _ = columns_of(plan, one_of(q.ravel().tolist()), at_end)
        return np.array([*zip(*J, strict=True)]).reshape(*q.shape[:-1], 6, n)
    columns = lambda q: jacobian_columns(plan, q, at_end)[0]  # noqa: E731
    return in_chunks(columns, (6, n), q)


def jacobian_columns(plan: Plan, q: Array, at_end: bool) -> tuple[Array, Array]:
    """Return the Jacobian, and where the end effector is.

    Args:
        plan, at_end: as in `columns_of`.
        q: finite configurations, (joints, n); n of about 1000 serves the cache best.

    Returns:
        J, (6, joints, n); the end's rotation and position side by side, (3, 4, n).
    """
    columns, end = columns_of(plan, chunk_of(q), at_end)
    J = np.empty((6, *q.shape))
    for adr, column in enumerate(columns):
        for row, number in zip(J, column, strict=True):
            row[adr] = number
    return J, rows_of(end, q.shape[1]).reshape(3, 4, -1)


def columns_of(plan: Plan, chunk: Chunk, at_end: bool) -> tuple[list[Any], Any]:
    """Return the Jacobian's columns, (omega; v) in world axes, and the end effector.

    Args:
        plan: from `chains.plan_of`.
        chunk: one configuration, or many.
        at_end: False for the velocity of the point at the origin (the space Jacobian),
            True for that of the end effector, in world axes.
    """
    nodes = plan.nodes(chunk)
    end = nodes[plan.frames[END]]
    x, y, z = end[3] if at_end else ZERO
    J: list[Any] = [(*ZERO, *ZERO)] * plan.nq
    for node, step in plan.joints:
        _, _, _, (u, v, w) = at = nodes[node]
        if isinstance(step, Slide):
            a, b, c, *linear = J[step.adr]
            J[step.adr] = (a, b, c, *moved(linear, step.along(at)))
            continue
        a, b, c = at[step.k]
        if step.sign < 0:
            a, b, c = -a, -b, -c
        u, v, w = x - u, y - v, z - w
        # (omega; omega x (end - point)), written out: np.cross takes longer.
        J[step.adr] = a, b, c, b * w - c * v, c * u - a * w, a * v - b * u
    return J, end

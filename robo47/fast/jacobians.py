"""The Jacobians of one arm at many configurations at once, in pure NumPy.

The chain of `robo47.fast.exponentials` turns a frame at each joint, about one of the
frame's own axes: where it stands, a Jacobian's column can be read off.

Units: metres, radians; screws are (omega; v).
"""

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import Plan, chunk_of, in_chunks, rows_of
from robo47.fast.exponentials import END, plan_of
from robo47.fast.moves import Slide, Turn, combine


def jacobians(screws: Array, M: Array, q: Array, at_end: bool) -> Array:
    """Return the Jacobian, (..., 6, joints), at finite q, (..., joints).

    The other arguments are those of `exponentials.plan_of` and `jacobian_columns`.
    """
    plan, n = plan_of(screws, M), q.shape[-1]
    if q.size == n:
        J, _ = plan.alone.jacobian(q.ravel().tolist(), at_end)
        return np.array([*zip(*J, strict=True)]).reshape(*q.shape[:-1], 6, n)
    columns = lambda q: jacobian_columns(plan, q, at_end)[0]  # noqa: E731
    return in_chunks(columns, (6, n), q)


def jacobian_columns(plan: Plan, q: Array, at_end: bool) -> tuple[Array, Array]:
    """Return the Jacobian, and where the end effector is.

    Args:
        plan: from `exponentials.plan_of`.
        q: finite configurations, (joints, n); n of about 1000 serves the cache best.
        at_end: False for the velocity of the point at the origin (the space Jacobian),
            True for that of the end effector, in world axes.

    Returns:
        J, (6, joints, n); the end's rotation and position side by side, (3, 4, n).
    """
    nodes = plan.nodes(chunk_of(q))
    frame, J, signs = plan.frames[END], np.zeros((6, *q.shape)), np.ones((len(q), 1))
    end = rows_of(nodes[frame.node], frame, q.shape[1])
    omega, v = J[:3], J[3:]
    moved = [*zip([step for _, step in plan.steps], nodes[1:], strict=True)]
    for step, at in moved:
        if isinstance(step, Turn):
            omega[:, step.adr], v[:, step.adr] = at[step.k], at.p
            signs[step.adr] = step.sign
    omega *= signs
    if at_end:
        v -= end[:, None, 3]
    (a, b, c), (x, y, z) = omega, v
    # v = point x omega, written out: np.cross takes ten times as long.
    v[0], v[1], v[2] = y * c - z * b, z * a - x * c, x * b - y * a
    for step, at in moved:
        if isinstance(step, Slide):
            v[:, step.adr] += combine(at, step.direction)
    return J, end

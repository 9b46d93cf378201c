"""The Jacobians of one arm at many configurations at once, in pure NumPy.

Each joint gets a frame of its own whose z axis is the screw's line: then e^[S1] q1 ...
is G1 Rz(q1) G2 Rz(q2) ..., with fixed G (`exponentials.arm_of`), and the joint's axis
is just the third column of its frame, wherever the arm is.

Units: metres, radians; screws are (omega; v).
"""

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import chunk_of
from robo47.fast.exponentials import Arm


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

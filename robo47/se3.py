"""Poses: 4x4 homogeneous transforms, and the rotations inside them.

Conventions, here and everywhere in the kit:

- `T_world_hand` maps hand coordinates to world coordinates, and it is also the pose
  of the hand, expressed in the world frame. Adjacent inner names cancel:
  `T_world_tip = T_world_hand @ T_hand_tip`.
- Points are columns: `p_world = T_world_hand @ p_hand`, with a 1 as fourth entry.
- Lengths in metres, angles in radians, quaternions as (w, x, y, z), all float64.
- Leading dimensions broadcast: a function that takes (4, 4) also takes (N, 4, 4).

Sources: Lynch and Park, Modern Robotics (2017), chapter 3, for the group; Shepperd,
"Quaternion from rotation matrix", J. Guidance and Control 1(3), 1978.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, was
from robo47.checks import RIGID_TOL, Array


def make_T(R: ArrayLike, t: ArrayLike) -> Array:
    """Return the homogeneous transform that rotates by R and then translates by t.

    Args:
        R: rotation matrix, (..., 3, 3).
        t: translation in metres, (..., 3).

    Returns:
        [[R, t], [0, 1]], (..., 4, 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or R is not a rotation.
    """
    R = checks.rotation(R, "R")
    t = checks.array(t, "t", (3,))
    T = np.zeros((*np.broadcast_shapes(R.shape[:-2], t.shape[:-1]), 4, 4))
    T[..., :3, :3] = R
    T[..., :3, 3] = t
    T[..., 3, 3] = 1.0
    return T


def inverse(T: ArrayLike) -> Array:
    """Return the inverse of a pose: `inverse(T_world_hand)` is `T_hand_world`.

    It consists of R^T and -R^T t. A general matrix inverse would also accept a matrix
    that is no pose (Modern Robotics, eq. 3.64).

    Args:
        T: pose, (..., 4, 4).

    Returns:
        The inverse pose, (..., 4, 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or T is not a pose.
    """
    T = checks.pose(T, "T")
    R_inv = np.swapaxes(T[..., :3, :3], -1, -2)
    out = np.zeros_like(T)
    out[..., :3, :3] = R_inv
    out[..., :3, 3] = -(R_inv @ T[..., :3, 3:])[..., 0]
    out[..., 3, 3] = 1.0
    return out


def Rx(theta: ArrayLike) -> Array:
    """Return the rotation matrix of a rotation by theta about the x axis.

    A positive angle rotates y towards z (Modern Robotics, section 3.2.1).

    Args:
        theta: angle in radians, (...).

    Returns:
        Rotation matrix, (..., 3, 3).

    Raises:
        ValueError: a non-finite angle.
    """
    return _turn_about(0, theta)


def Ry(theta: ArrayLike) -> Array:
    """Return the rotation matrix (..., 3, 3) by theta, radians (...), about y.

    A positive angle rotates z towards x.

    Raises:
        ValueError: a non-finite angle.
    """
    return _turn_about(1, theta)


def Rz(theta: ArrayLike) -> Array:
    """Return the rotation matrix (..., 3, 3) by theta, radians (...), about z.

    A positive angle rotates x towards y: `Rz(np.pi / 2)` maps (1, 0, 0) to (0, 1, 0).

    Raises:
        ValueError: a non-finite angle.
    """
    return _turn_about(2, theta)


def quat_to_R(q_wxyz: ArrayLike) -> Array:
    """Return the rotation matrix of a quaternion, which is normalised first.

    Only a unit quaternion represents a rotation, and model files contain others: `quat=
    "1 -1 0 0"` has the norm sqrt(2).

    Args:
        q_wxyz: quaternion of any norm except 0, scalar part first as in MuJoCo,
            (..., 4).

    Returns:
        Rotation matrix, (..., 3, 3).

    Raises:
        ValueError: wrong shape, a non-finite number, or a quaternion of norm 0.
    """
    w, x, y, z = np.moveaxis(
        checks.unit(checks.array(q_wxyz, "q_wxyz", (4,)), "q_wxyz"), -1, 0
    )
    rows = np.array([
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ])  # fmt: skip
    return np.ascontiguousarray(np.moveaxis(rows, (0, 1), (-2, -1)))


def R_to_quat(R: ArrayLike) -> Array:
    """Return the unit quaternion of a rotation matrix, with w >= 0.

    q and -q represent the same rotation; the sign is fixed so that two results can be
    compared. The largest of the four components is computed first, so that no division
    is by a small number (Shepperd 1978).

    Args:
        R: rotation matrix, (..., 3, 3).

    Returns:
        Quaternion (w, x, y, z), (..., 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or R is not a rotation.
    """
    R = checks.rotation(R, "R")
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = np.moveaxis(R, (-2, -1), (0, 1))
    # Row k is 4 q_k times the whole quaternion. The row with the largest k-th entry,
    # 4 q_k^2, is the best conditioned one.
    rows = np.array([
        [1 + xx + yy + zz, zy - yz, xz - zx, yx - xy],
        [zy - yz, 1 + xx - yy - zz, yx + xy, xz + zx],
        [xz - zx, yx + xy, 1 - xx + yy - zz, zy + yz],
        [yx - xy, xz + zx, zy + yz, 1 - xx - yy + zz],
    ])  # fmt: skip
    table = np.moveaxis(rows, (0, 1), (-2, -1))
    best = np.argmax(np.diagonal(table, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(table, best[..., None, None], axis=-2)[..., 0, :]
    q /= np.linalg.norm(q, axis=-1, keepdims=True)
    return np.where(q[..., :1] < 0, -q, q)


def is_rotation(R: ArrayLike, tol: float = RIGID_TOL) -> bool:
    """Return whether every matrix is a rotation matrix: orthonormal, determinant +1.

    Args:
        R: matrix, (..., 3, 3).
        tol: the largest permitted entry of R R^T - I.

    Returns:
        True if all are rotations; False also for other shapes and non-finite numbers.
    """
    R = np.asarray(R, dtype=np.float64)
    return (
        R.shape[-2:] == (3, 3)
        and bool(np.isfinite(R).all())
        and checks.rotation_flaw(R, tol) is None
    )


def is_pose(T: ArrayLike, tol: float = RIGID_TOL) -> bool:
    """Return whether every matrix is a pose: a rotation, and (0, 0, 0, 1) below.

    Args:
        T: matrix, (..., 4, 4).
        tol: as in `is_rotation`, also for the bottom row.

    Returns:
        True if all are poses; False also for other shapes and non-finite numbers.
    """
    T = np.asarray(T, dtype=np.float64)
    return (
        T.shape[-2:] == (4, 4)
        and bool(np.isfinite(T).all())
        and checks.pose_flaw(T, tol) is None
    )


def pose_distance(T_a: ArrayLike, T_b: ArrayLike) -> tuple[Array, Array]:
    """Return the distance and the angle between two poses.

    The angle is computed from the quaternion of the relative rotation with atan2, which
    is accurate near 0 and near pi. arccos((trace - 1) / 2) loses half of its digits
    there, and it is NaN if rounding makes the trace larger than 3.

    Args:
        T_a: pose, (..., 4, 4).
        T_b: pose, (..., 4, 4).

    Returns:
        Distance in metres (...) and angle in radians in [0, pi] (...).

    Raises:
        ValueError: wrong shape, a non-finite number, or not a pose.
    """
    T_a = checks.pose(T_a, "T_a")
    T_b = checks.pose(T_b, "T_b")
    metres = np.linalg.norm(T_a[..., :3, 3] - T_b[..., :3, 3], axis=-1)
    R_ab = np.swapaxes(T_a[..., :3, :3], -1, -2) @ T_b[..., :3, :3]
    q = R_to_quat(R_ab)
    radians = 2.0 * np.arctan2(np.linalg.norm(q[..., 1:], axis=-1), q[..., 0])
    return metres, radians


def _turn_about(k: int, theta: ArrayLike) -> Array:
    theta = checks.array(theta, "theta", ())
    i, j = (k + 1) % 3, (k + 2) % 3  # the rotation moves axis i towards axis j
    R = np.zeros((*theta.shape, 3, 3))
    R[..., k, k] = 1.0
    R[..., i, i] = R[..., j, j] = np.cos(theta)
    R[..., j, i] = np.sin(theta)
    R[..., i, j] = -R[..., j, i]
    return R


__getattr__ = was.moved(__name__)

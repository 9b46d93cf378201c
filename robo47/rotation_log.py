"""Logarithms of rotations and poses, and the pose error.

Radians, metres; world frame; leading dimensions broadcast.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array

SMALL = 0.03  # radians; the next term of the series is 4e-16 of b there


def log_rotation(R: ArrayLike) -> Array:
    """Return the rotation vector of a rotation, its unit axis times its angle.

    It is computed from the unit quaternion (w; u), whose angle is 2 atan2(|u|, w). This
    is accurate near 0, where the usual formula's arccosine loses digits, and near pi,
    where its division by the sine does (Modern Robotics, section 3.2.3.3).

    Args:
        R: rotation matrix, (..., 3, 3).

    Returns:
        Rotation vector, radians, with a norm in [0, pi], (..., 3). At exactly pi both
        signs represent the same rotation; the entry of largest absolute value is then
        positive. Within 1e-16 of pi rounding determines the sign.

    Raises:
        ValueError: wrong shape, a non-finite number, or R is not a rotation.
    """
    q = se3.R_to_quat(R)
    w = q[..., :1]
    u = q[..., 1:]
    sine = np.linalg.norm(u, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, w)
    # Below 1e-154 the square of a norm is 0; there the angle is twice the sine.
    return u * np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 0.0)


def log_pose(T: ArrayLike) -> Array:
    """Return the logarithm of a pose, S theta: the inverse of the exponential.

    omega theta = log(R), and v theta = G^-1 p with G^-1 = I - [w]/2 + b [w]^2, where
    w = omega theta and b = (1 - (theta/2) cot(theta/2)) / theta^2 (Modern Robotics,
    eq. 3.92). For the result x, `screws.exp_screw(x / theta, theta)` returns T, where
    theta is the norm of omega theta, or of v theta for a pure translation.

    Args:
        T: pose, (..., 4, 4).

    Returns:
        (omega theta; v theta), radians and metres, (..., 6). For a rotation by exactly
        pi the sign is chosen as in `log_rotation`.

    Raises:
        ValueError: wrong shape, a non-finite number, or not a pose.
    """
    T = checks.pose(T, "T")
    w = log_rotation(T[..., :3, :3])
    p = T[..., :3, 3]
    theta = np.linalg.norm(w, axis=-1, keepdims=True)
    half = 0.5 * theta
    small = theta < SMALL
    safe = np.where(small, 1.0, half)
    # tan(pi/2) is a large number in floats, so a turn of pi needs no case of its own.
    exact = (1.0 - safe / np.tan(safe)) / (4.0 * safe**2)
    # The series to theta^4: `exact` loses digits as 1e-16 / theta^2.
    b = np.where(small, 1.0 / 12.0 + theta**2 / 720.0 + theta**4 / 30240.0, exact)
    around = np.cross(w, p)
    v = p - 0.5 * around + b * np.cross(w, around)
    return np.concatenate([w, v], axis=-1)


def pose_error(T: ArrayLike, T_goal: ArrayLike) -> Array:
    """Return the pose error from T to the goal: a rotation vector and a translation.

    It is (log(R_goal R^T); p_goal - p), expressed in the world frame, as needed with
    J_site. `se3.pose_distance` returns the norms of its two parts.

    Args:
        T: pose, (..., 4, 4).
        T_goal: the goal, (..., 4, 4).

    Returns:
        Error, radians above and metres below, (..., 6).

    Raises:
        ValueError: wrong shape, a non-finite number, or not poses.
    """
    T = checks.pose(T, "T")
    T_goal = checks.pose(T_goal, "T_goal")
    turn = log_rotation(T_goal[..., :3, :3] @ np.swapaxes(T[..., :3, :3], -1, -2))
    return np.concatenate([turn, T_goal[..., :3, 3] - T[..., :3, 3]], axis=-1)


def small_pose_error(T: Array, T_goal: Array) -> Array:
    """Return `pose_error` for use in a loop: without checks and 20 times as fast.

    It is for rotations by less than 90 degrees, which their sine determines.

    Args:
        T: pose, (4, 4).
        T_goal: the goal, (4, 4).

    Returns:
        Rotation vector and translation to the goal, in the world frame, (6,).
    """
    E = T_goal[:3, :3] @ T[:3, :3].T
    x, y, z = E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]
    sine = 0.5 * math.sqrt(x * x + y * y + z * z)
    half = 0.5 * math.asin(min(sine, 1.0)) / sine if sine > 0.0 else 0.5
    dx, dy, dz = T_goal[:3, 3] - T[:3, 3]
    return np.array([half * x, half * y, half * z, dx, dy, dz])

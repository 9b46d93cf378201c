"""Representations of orientation: roll, pitch and yaw, and unit quaternions.

Conventions: radians; quaternions are (w, x, y, z) of norm 1, as in MuJoCo, and are
normalised first. Roll, pitch and yaw are rotations about the fixed x, y and z axes of
the world in this order, R = Rz(yaw) Ry(pitch) Rx(roll). The same R results from yaw,
pitch and roll about the moving z, y and x axes. Leading dimensions broadcast.

Sources: Lynch and Park, *Modern Robotics* (2017), appendix B (roll-pitch-yaw angles,
unit quaternions); Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array

GIMBAL = 1e-7  # cosine of the pitch below which roll and yaw have one axis
NEARLY_ONE = 1e-8  # angle below which slerp's sines are their angles, to all digits


def rpy_to_R(rpy: ArrayLike) -> Array:
    """Return the rotation matrix of roll, pitch and yaw: Rz(yaw) Ry(pitch) Rx(roll).

    Args:
        rpy: roll, pitch, yaw in radians, (..., 3).

    Returns:
        Rotation matrix, (..., 3, 3).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    roll, pitch, yaw = np.moveaxis(checks.array(rpy, "rpy", (3,)), -1, 0)
    return se3.Rz(yaw) @ se3.Ry(pitch) @ se3.Rx(roll)


def R_to_rpy(R: ArrayLike) -> Array:
    """Return roll, pitch and yaw of a rotation matrix.

    At a pitch of +-90 degrees (gimbal lock) roll and yaw are about the same axis, and R
    determines only their difference or sum; the roll is then 0.

    Args:
        R: rotation matrix, (..., 3, 3).

    Returns:
        Roll in [-pi, pi], pitch in [-pi/2, pi/2] and yaw in [-pi, pi], (..., 3).

    Raises:
        ValueError: wrong shape, a non-finite number, or R is not a rotation.
    """
    R = checks.rotation(R, "R")
    # Both square roots are the pitch's cosine; atan2 keeps its digits near 90 degrees.
    cosine = np.hypot(R[..., 0, 0], R[..., 1, 0])
    pitch = np.arctan2(-R[..., 2, 0], cosine)
    locked = cosine < GIMBAL
    roll = np.where(locked, 0.0, np.arctan2(R[..., 2, 1], R[..., 2, 2]))
    free = np.arctan2(R[..., 1, 0], R[..., 0, 0])
    yaw = np.where(locked, np.arctan2(-R[..., 0, 1], R[..., 1, 1]), free)
    return np.stack([roll, pitch, yaw], axis=-1)


def quat_product(p_wxyz: ArrayLike, q_wxyz: ArrayLike) -> Array:
    """Return the quaternion product p q, whose rotation is R(p) R(q).

    The rotation of q is applied first. Hamilton's product is (p0 q0 - p.q; p0 q + q0 p
    + p x q) (Modern Robotics, appendix B.3).

    Args:
        p_wxyz, q_wxyz: quaternions, (..., 4).

    Returns:
        Unit quaternion (w, x, y, z), (..., 4), with the sign of the product.

    Raises:
        ValueError: wrong shape, a non-finite number, or a quaternion of norm 0.
    """
    p = _unit(p_wxyz, "p_wxyz")
    q = _unit(q_wxyz, "q_wxyz")
    u = p[..., 1:]
    v = q[..., 1:]
    w = p[..., 0] * q[..., 0] - (u * v).sum(axis=-1)
    vector = p[..., :1] * v + q[..., :1] * u + np.cross(u, v)
    return np.concatenate([w[..., None], vector], axis=-1)


def slerp(p_wxyz: ArrayLike, q_wxyz: ArrayLike, s: ArrayLike) -> Array:
    """Return the quaternion after the fraction s of the shorter rotation from p to q.

    (sin((1 - s) a) p + sin(s a) q) / sin(a), with a the angle between p and q in four
    dimensions, half of the rotation's angle (Shoemake 1985). q and -q represent one
    rotation; the one nearer to p is used, so the rotation is by at most pi.

    Args:
        p_wxyz, q_wxyz: quaternions, (..., 4).
        s: fraction of the rotation, (...); 0 gives p, 1 gives q or -q.

    Returns:
        Unit quaternion (w, x, y, z), (..., 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or a quaternion of norm 0.
    """
    p = _unit(p_wxyz, "p_wxyz")
    q = _unit(q_wxyz, "q_wxyz")
    s = checks.array(s, "s", ())[..., None]
    q = np.where((p * q).sum(axis=-1, keepdims=True) < 0.0, -q, q)
    # By both norms, because the arccosine of p . q has half of the digits near p = q.
    apart = np.linalg.norm(q - p, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(apart, np.linalg.norm(q + p, axis=-1, keepdims=True))
    near = angle < NEARLY_ONE
    sine = np.where(near, 1.0, np.sin(angle))
    first = np.where(near, 1.0 - s, np.sin((1.0 - s) * angle) / sine)
    last = np.where(near, s, np.sin(s * angle) / sine)
    return checks.unit(first * p + last * q, "slerp")


def _unit(q_wxyz: ArrayLike, name: str) -> Array:
    return checks.unit(checks.array(q_wxyz, name, (4,)), name)

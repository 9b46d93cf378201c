"""Screws: joints as lines in space, and the product of exponentials.

A joint is a screw axis S = (omega; v), (6,): omega is the unit vector along its axis of
rotation, and v the velocity of the point at the origin for a rotation at 1 rad/s. A
slide has omega = 0 and translates along v. Conventions:

- Twists and screws are (omega; v), as in *Modern Robotics* and MuJoCo's `cvel`;
  Pinocchio, `mj_jac` and a free joint's `qvel` have v first.
- Space screws are expressed in the world frame, body screws in the end effector's
  frame, both with the arm at q = 0, where the end effector's pose is M (`M_home` in
  code).
- Angles in radians, lengths in metres, float64; leading dimensions broadcast.

Source: Lynch and Park, *Modern Robotics* (2017), chapters 3 and 4.
"""

import functools

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3, was
from robo47.checks import Array
from robo47.dh import dh_fk as dh_fk  # Denavit and Hartenberg's method
from robo47.dh import dh_link as dh_link
from robo47.fast.chains import END, evaluate, plan_of
from robo47.fast.vectors import cross_of


def skew(w: ArrayLike) -> Array:
    """Return the skew-symmetric matrix [w], for which [w] p = w x p.

    Args:
        w: vector, (..., 3), in any unit.

    Returns:
        Skew-symmetric matrix, (..., 3, 3), in the same unit (Modern Robotics, section
        3.2.2).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    w = checks.array(w, "w", (3,))
    if w.ndim == 1:  # called thousands of times by labs; 0.0 - z makes no -0
        x, y, z = w.tolist()
        return np.array([[0.0, 0.0 - z, y], [z, 0.0, 0.0 - x], [0.0 - y, x, 0.0]])
    K = np.zeros((*w.shape, 3))
    K[..., 2, 1], K[..., 0, 2], K[..., 1, 0] = np.moveaxis(w, -1, 0)
    K -= np.swapaxes(K, -1, -2)
    return K


def axis_angle(axis: ArrayLike, theta: ArrayLike) -> Array:
    """Return the rotation matrix by theta about an axis of any norm.

    Rodrigues' formula: R = I + sin(theta) K + (1 - cos(theta)) K K, where K = [axis] of
    the normalised axis (Modern Robotics, eq. 3.51).

    Args:
        axis: direction of the axis, (..., 3), of any norm but 0.
        theta: angle in radians, (...).

    Returns:
        Rotation matrix, (..., 3, 3).

    Raises:
        ValueError: wrong shape, a non-finite number, or an axis of norm 0.
    """
    axis = checks.array(axis, "axis", (3,))
    theta = checks.array(theta, "theta", ())
    x, y, z = np.moveaxis(checks.unit(axis, "axis"), -1, 0)
    zero = np.zeros_like(x)
    K = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1)
    K = K.reshape(*x.shape, 3, 3)
    s, c = np.sin(theta)[..., None, None], np.cos(theta)[..., None, None]
    return np.eye(3) + s * K + (1.0 - c) * (K @ K)


def exp_rotation(axis: ArrayLike, theta: ArrayLike) -> Array:
    """Return the rotation matrix exp([axis] theta) about a unit axis.

    I + sin(theta) [axis] + (1 - cos(theta)) [axis]^2, Rodrigues' formula (Modern
    Robotics, eq. 3.51). `axis_angle` takes an axis of any norm.

    Args:
        axis: unit vector, (..., 3).
        theta: angle in radians, (...).

    Returns:
        Rotation matrix, (..., 3, 3).

    Raises:
        ValueError: wrong shape, a non-finite number, or an axis that is no unit vector.
    """
    axis = checks.unit_vector(axis, "axis")
    return axis_angle(axis, theta)


def screw_axis(axis: ArrayLike, point: ArrayLike) -> Array:
    """Return the screw axis of a hinge: omega = axis, v = -omega x point.

    v is the velocity of the body's point at the origin while the body rotates at
    1 rad/s. `screw_axis([0, 0, 1], [1, 0, 0])` is (0, 0, 1, 0, -1, 0).

    Args:
        axis: unit vector of the axis of rotation, (..., 3).
        point: any point on that axis, metres, (..., 3).

    Returns:
        Screw axis (omega; v), (..., 6), v in metres per radian (Modern Robotics,
        section 3.3.2.2).

    Raises:
        ValueError: wrong shape, a non-finite number, or an axis that is no unit vector.
    """
    axis = checks.unit_vector(axis, "axis")
    point = checks.array(point, "point", (3,))
    v = cross_of(point, axis)
    return np.concatenate([np.broadcast_to(axis, v.shape), v], axis=-1)


def joint_screws(T_zero: ArrayLike) -> Array:
    """Return the space screws of an arm whose joints rotate about their links' z axes.

    Args:
        T_zero: `T_world_link` of every moving link at q = 0, (..., n, 4, 4).

    Returns:
        Space screws (omega; v), expressed in the world frame, (..., n, 6).

    Raises:
        ValueError: wrong shape, a non-finite number, or not poses.
    """
    T_zero = checks.pose(T_zero, "T_zero")
    return screw_axis(T_zero[..., :3, 2], T_zero[..., :3, 3])


def exp_screw(S: ArrayLike, theta: ArrayLike) -> Array:
    """Return the exponential of a screw: the pose after a motion by theta along it.

    R = exp([omega] theta) and t = (theta I + (1 - cos) [omega] + (theta - sin)
    [omega]^2) v; with omega = 0 this is the translation theta v (Modern Robotics, eq.
    3.88).

    Args:
        S: screw (omega; v) with an omega of norm 1 or 0, (..., 6).
        theta: radians, metres for a slide, (...).

    Returns:
        Pose, (..., 4, 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or an omega of another norm.
    """
    S = checks.screws(S, "S")
    theta = checks.array(theta, "theta", ())
    K = skew(S[..., :3])
    v = S[..., 3:, None]
    KK = K @ K
    angle = theta[..., None, None]
    s = np.sin(angle)
    c = 2.0 * np.sin(0.5 * angle) ** 2  # 1 - cos, with all digits at small angles
    R = np.eye(3) + s * K + c * KK
    out = np.zeros((*R.shape[:-2], 4, 4))
    out[..., :3, :3] = R
    out[..., :3, 3:] = (angle * np.eye(3) + c * K + (angle - s) * KK) @ v
    out[..., 3, 3] = 1.0
    return out


def adjoint(T: ArrayLike) -> Array:
    """Return the adjoint Ad(T): adjoint(T_a_b) @ V_b is the twist expressed in frame a.

    Ad(T) = [[R, 0], [[p] R, R]] (Modern Robotics, definition 3.20).

    Args:
        T: pose `T_a_b`, metres, (..., 4, 4).

    Returns:
        Matrix for twists (omega; v), (..., 6, 6).

    Raises:
        ValueError: wrong shape, a non-finite number, or not a pose.
    """
    T = checks.pose(T, "T")
    R = T[..., :3, :3]
    out = np.zeros((*T.shape[:-2], 6, 6))
    out[..., :3, :3] = out[..., 3:, 3:] = R
    out[..., 3:, :3] = skew(T[..., :3, 3]) @ R
    return out


def fk_space(screws: ArrayLike, M_home: ArrayLike, q: ArrayLike) -> Array:
    """Return the end effector's pose by space screws, e^([S1] q1) ... e^([Sn] qn) M.

    Many configurations of one arm are computed in one vectorised pass (`fast.chains`),
    as fast as `kinematics.fk`.

    Args:
        screws: space screws (omega; v) at q = 0, in the joints' order, (..., n, 6).
        M_home: `T_world_ee` at q = 0, (..., 4, 4).
        q: joint angles in radians (metres for slides), (..., n).

    Returns:
        T_world_ee, (..., 4, 4); at q = 0 it is M_home.

    Raises:
        ValueError: wrong shape, a non-finite number, no screw or not a pose.
    """
    S, q = checks.screws_and_q(screws, q)
    M_home = checks.pose(M_home, "M_home")
    if S.ndim == M_home.ndim == 2:
        return evaluate(plan_of(S, M_home), q)[END]
    steps = [exp_screw(S[..., i, :], q[..., i]) for i in range(S.shape[-2])]
    return functools.reduce(np.matmul, steps) @ M_home


def body_screws(screws: ArrayLike, M_home: ArrayLike) -> Array:
    """Return the body screws: the space screws in the end effector's frame, Ad(M^-1) S.

    Args:
        screws, M_home: as in `fk_space`.

    Returns:
        Body screws (omega; v), (..., n, 6) (Modern Robotics, section 4.1.3).

    Raises:
        ValueError: as `fk_space`.
    """
    S = checks.screws(screws, "screws")
    return S @ np.swapaxes(adjoint(se3.inverse(M_home)), -1, -2)


def fk_body(body_screws: ArrayLike, M_home: ArrayLike, q: ArrayLike) -> Array:
    """Return the end effector's pose by body screws, M e^([B1] q1) ... e^([Bn] qn).

    Because M e^[B] = e^[Ad(M) B] M, this equals `fk_space` with the space screws
    Ad(M) B.

    Args:
        body_screws: body screws (omega; v) at q = 0, (..., n, 6).
        M_home, q: as in `fk_space`.

    Returns:
        T_world_ee, (..., 4, 4) (Modern Robotics, section 4.1.3).

    Raises:
        ValueError: as `fk_space`.
    """
    B = checks.screws(body_screws, "body_screws")
    return fk_space(B @ np.swapaxes(adjoint(M_home), -1, -2), M_home, q)


__getattr__ = was.moved(__name__)

"""Jacobians of an arm, pose errors, and the steps of inverse kinematics.

Three Jacobians map joint velocities to a twist (omega; v). Their names differ:

- `J_space`: v is the velocity of the point at the world's origin; world frame.
- `J_site`: v is the velocity of a point of the hand; world frame. MuJoCo's mj_jacSite
  computes it (its jacr above its jacp).
- `J_body`: v is the velocity of the hand's own origin, both in the hand frame.

Twists are (omega; v) as in *Modern Robotics*; Pinocchio's are (v; omega). Radians,
metres, float64; leading dimensions broadcast.

Source: Lynch and Park, *Modern Robotics* (2017), chapters 5 and 6. `robo47.fast.ik` and
`robo47.rotation_log` contain the other functions of this module.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.fast.ik import reached as reached
from robo47.fast.ik import solve_ik as solve_ik
from robo47.fast.jacobians import jacobians
from robo47.rotation_log import log_rotation as log_rotation
from robo47.rotation_log import pose_error as pose_error
from robo47.screws import adjoint, exp_screw, skew

# A singular value below this fraction of the largest one is treated as 0.
SINGULAR = 1e-12


def space_jacobian(screws: ArrayLike, q: ArrayLike) -> Array:
    """Return the space Jacobian, whose columns are the current screws of the joints.

    Column i is Ad(e^[S1] q1 ... e^[S(i-1)] q(i-1)) S_i (Modern Robotics, section
    5.1.1). At q = 0 the columns are the screws.

    Args:
        screws: space screws (omega; v), (..., n, 6).
        q: joint angles in radians (metres for slides), (..., n).

    Returns:
        J_space, (..., 6, n): no unit in the upper rows, metres in the lower.

    Raises:
        ValueError: wrong shape, a non-finite number, or no screw.
    """
    S, q = checks.screws_and_q(screws, q)
    if S.ndim > 2:
        return _one_by_one(S, q)
    return jacobians(S, np.eye(4), q, at_end=False)


def site_jacobian(J_space: ArrayLike, p: ArrayLike) -> Array:
    """Return the site Jacobian, for the velocity of the point p in the world frame.

    v_p = v + omega x p in each column; omega is the same (Modern Robotics, section
    3.3.2).

    Args:
        J_space: from `space_jacobian`, (..., 6, n).
        p: a point that moves with the hand, in the world frame, metres, (..., 3).

    Returns:
        J_site, (..., 6, n), with omega above: the Jacobian of MuJoCo's mj_jacSite.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    p = checks.array(p, "p", (3,))
    v = J[..., 3:, :] - skew(p) @ J[..., :3, :]  # omega x p = -[p] omega
    return np.concatenate([np.broadcast_to(J[..., :3, :], v.shape), v], axis=-2)


def body_jacobian(J_space: ArrayLike, T: ArrayLike) -> Array:
    """Return the body Jacobian, Ad(T^-1) J_space, expressed in the hand frame.

    Args:
        J_space: from `space_jacobian`, (..., 6, n).
        T: `T_world_ee` at the same configuration, (..., 4, 4).

    Returns:
        J_body, (..., 6, n) (Modern Robotics, section 5.1.4).

    Raises:
        ValueError: wrong shape, a non-finite number, or not a pose.
    """
    return adjoint(se3.inverse(T)) @ checks.array(J_space, "J_space", (6, "n"))


def joint_torques(J_space: ArrayLike, p: ArrayLike, F: ArrayLike) -> Array:
    """Return the joint torques with which the hand exerts a wrench at a point.

    They are J_site^T F, because the power of the motors, tau . qd, equals the power of
    the hand, F . V (Modern Robotics, section 5.2).

    Args:
        J_space: from `space_jacobian`, (..., 6, n).
        p: the point of contact in the world frame, metres, (..., 3).
        F: moment about p and force, in the world frame, N m and N, (..., 6).

    Returns:
        Torques, N m (forces of slides, N), (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = site_jacobian(J_space, p)
    F = checks.array(F, "F", (6,))
    return (F[..., None, :] @ J)[..., 0, :]


def dls_step(J_site: ArrayLike, e: ArrayLike, damping: ArrayLike) -> Array:
    """Return the damped least-squares step, J^T (J J^T + damping^2 I)^-1 e.

    It minimises |J dq - e|^2 + damping^2 |dq|^2, so it remains short where J is nearly
    singular (Wampler, "Manipulator inverse kinematic solutions based on vector
    formulations and damped least-squares methods", IEEE Trans. SMC 16(1), 1986).

    Args:
        J_site: site Jacobian, (..., m, n), if e is a `pose_error` in the world frame.
        e: wanted motion, (..., m), in the frame and order of the Jacobian.
        damping: (...); a larger one gives shorter steps, 0 is the pseudo-inverse.

    Returns:
        Step dq, radians, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a singular J without damping.
    """
    J = checks.array(J_site, "J_site", ("m", "n"))
    e = checks.array(e, "e", J.shape[-2:-1])
    damping = checks.array(damping, "damping", ())
    Jt = np.swapaxes(J, -1, -2)
    A = J @ Jt + damping[..., None, None] ** 2 * np.eye(J.shape[-2])
    try:
        y = np.linalg.solve(A, e[..., None])
    except np.linalg.LinAlgError:
        raise ValueError("J is singular and damping is 0: give it damping") from None
    return (Jt @ y)[..., 0]


def manipulability(J: ArrayLike) -> Array:
    """Return Yoshikawa's manipulability sqrt(det(J J^T)), which is 0 at a singularity.

    It is the product of the singular values, and the volume of the manipulability
    ellipsoid except for a constant factor (Yoshikawa, "Manipulability of robotic
    mechanisms", Int. J. Robotics Research 4(2), 1985).

    Args:
        J: any of the three Jacobians, (..., m, n); with m > n the result is 0.

    Returns:
        The manipulability, (...).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J, "J", ("m", "n"))
    # The singular values are used because det(J J^T) has only half the digits near 0.
    values = np.linalg.svd(J, compute_uv=False).prod(axis=-1)
    return values if J.shape[-2] <= J.shape[-1] else 0.0 * values


def nullspace_projection(J: ArrayLike, dq: ArrayLike) -> Array:
    """Return the part of dq in the null space of J: dq - J^+ J dq.

    Args:
        J: any of the three Jacobians, (..., m, n); they have the same null space.
        dq: wanted motion of the joints, (..., n).

    Returns:
        The motion with J dq = 0 that is nearest to dq, (..., n) (Modern Robotics,
        section 6.3).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J, "J", ("m", "n"))
    dq = checks.array(dq, "dq", J.shape[-1:])
    _, values, Vt = np.linalg.svd(J, full_matrices=False)
    # J^+ J = V V^T over the directions that move the hand; no division is needed.
    felt = values > SINGULAR * values.max(axis=-1, keepdims=True, initial=0.0)
    along = np.where(felt, (Vt @ dq[..., None])[..., 0], 0.0)
    return dq - (along[..., None, :] @ Vt)[..., 0, :]


def _one_by_one(S: Array, q: Array) -> Array:
    """Return J_space of arms with different screws, column by column."""
    T = np.eye(4)
    columns = []
    for i in range(S.shape[-2]):
        columns.append((adjoint(T) @ S[..., i, :, None])[..., 0])
        T = T @ exp_screw(S[..., i, :], q[..., i])
    return np.stack(np.broadcast_arrays(*columns), axis=-1)

"""3.9 `body_jacobian(J_space, T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Jacobian, Row
from robo47 import jacobian, se3
from robo47.jacobian import site_jacobian
from robo47.screws import adjoint, fk_space, skew

from .jacobians import arm

row = Row(Jacobian())


@row.inputs
def _(rng):
    S, M, _ = arm()
    q = rng.configurations(8)
    J = jacobian.space_jacobian(S, q)
    return [(J[0], np.eye(4)), *zip(J, fk_space(S, M, q), strict=True)]


@row.wrongs
def _(J_space, T):
    """space-for-body: your code returns J_space, which is expressed in the world frame.
      Return J_body instead, which is expressed in the hand frame
    site-for-body: your code returns J_site, whose v belongs to the correct point but is
      expressed in the world frame. Express both halves in the hand frame
    rotation-only: your code only rotates J_space into the hand frame, so v is still the
      velocity of the body-fixed point at the world origin. Use the velocity of the
      point at the hand origin instead
    transposed-adjoint: your result is Ad(T)^T J_space. Use Ad(T^-1) instead, which is
      the inverse of Ad(T)
    bracket-without-R: your v contains the term p x omega instead of p x (R omega),
      where R and p are the rotation and the translation of T^-1. In an adjoint, this is
      the block [p] instead of [p] R
    bracket-on-the-right: your v contains the term R (p x omega) instead of p x (R
      omega), where R and p are the rotation and the translation of T^-1. In an adjoint,
      this is the block R [p] instead of [p] R
    turned-by-R: both halves of your result are multiplied by R, which rotates from the
      hand frame to the world frame. Both halves should be multiplied by R^T instead
    point-not-rotated: your v contains the term (R^T omega) x p with p in the world
      frame, where R and p are the rotation and the translation of T. Use R^T (omega x
      p) instead, so that both factors are expressed in the same frame
    """
    J_site = site_jacobian(J_space, T[:3, 3])
    R = np.kron(np.eye(2), T[:3, :3])
    back = se3.inverse(T)
    shift = np.kron([[0.0, 0.0], [1.0, 0.0]], -skew(T[:3, 3]))
    turned = np.kron(np.eye(2), back[:3, :3])
    lower = np.kron([[0.0, 0.0], [1.0, 0.0]], skew(back[:3, 3]))
    return {
        "space-for-body": J_space,
        "site-for-body": J_site,
        "rotation-only": R.T @ J_space,
        "transposed-adjoint": adjoint(T).T @ J_space,
        "bracket-without-R": (turned + lower) @ J_space,
        "bracket-on-the-right": (turned + turned @ lower) @ J_space,
        "turned-by-R": R @ J_site,
        "point-not-rotated": (np.eye(6) + shift) @ R.T @ J_space,
    }


@row.right  # Half by half, without an adjoint.
def _(J_space, T):
    R, p = T[:3, :3], T[:3, 3]
    omega, v = J_space[:3].T, J_space[3:].T
    v_hand = v - np.cross(p, omega)  # velocity of the hand's origin
    omega_body = omega @ R  # omega, expressed in the hand frame
    v_body = v_hand @ R  # v, expressed in the hand frame
    return np.hstack([omega_body, v_body]).T

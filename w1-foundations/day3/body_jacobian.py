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
    """adjoint-of-T: T leads from the hand to the world; here the twists are to be taken
      back => the Jacobian with Ad(T)
    space-for-body: this is J_space still, as the world sees it => J_space itself
    site-for-body: this is J_site: the velocity of the right point, but in the world's
      axes => J_site
    rotation-only: J_space is turned into the hand's axes, but v is still that of the
      point at the world's origin => J_space in the hand's axes
    transposed-adjoint: this is Ad(T) transposed; the inverse of an adjoint is not its
      transpose => the Jacobian with that transpose
    bracket-without-R: in the adjoint stands [p] alone at the lower left; it is [p] R =>
      the Jacobian with that adjoint
    bracket-on-the-right: in the adjoint stands R [p] at the lower left; it is [p] R =>
      the Jacobian with that adjoint
    turned-by-R: J_site is turned by R, which leads from the hand's axes to the world's;
      the way back is R^T => J_site turned by R
    """
    J_site = site_jacobian(J_space, T[:3, 3])
    R = np.kron(np.eye(2), T[:3, :3])
    back = se3.inverse(T)
    turned = np.kron(np.eye(2), back[:3, :3])
    lower = np.kron([[0.0, 0.0], [1.0, 0.0]], skew(back[:3, 3]))
    return {
        "adjoint-of-T": adjoint(T) @ J_space,
        "space-for-body": J_space,
        "site-for-body": J_site,
        "rotation-only": R.T @ J_space,
        "transposed-adjoint": adjoint(T).T @ J_space,
        "bracket-without-R": (turned + lower) @ J_space,
        "bracket-on-the-right": (turned + turned @ lower) @ J_space,
        "turned-by-R": R @ J_site,
    }

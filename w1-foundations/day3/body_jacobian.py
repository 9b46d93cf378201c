"""3.9 `body_jacobian(J_space, T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Jacobian, draw
from labkit.judge.row import Row
from robo47 import jacobian
from robo47.jacobian import site_jacobian
from robo47.screws import adjoint, fk_space

from .jacobians import arm

row = Row(Jacobian())


@row.inputs
def _(rng):
    S, M, _ = arm()
    q = draw.configurations(rng, 8)
    J = jacobian.space_jacobian(S, q)
    return [(J[0], np.eye(4)), *zip(J, fk_space(S, M, q), strict=True)]


def turned(J, R):
    """Return both halves of a Jacobian turned by R."""
    return np.vstack([R @ J[:3], R @ J[3:]])


@row.wrong
def adjoint_of_T(J_space, T):
    """T leads from the hand to the world; here the twists are to be taken back => the
    Jacobian with Ad(T)"""
    return adjoint(T) @ J_space


@row.wrong
def space_for_body(J_space, T):
    """this is J_space still, as the world sees it => J_space itself"""
    return J_space.copy()


@row.wrong
def site_for_body(J_space, T):
    """this is J_site: the velocity of the right point, but in the world's axes =>
    J_site"""
    return site_jacobian(J_space, T[:3, 3])


@row.wrong
def rotation_only(J_space, T):
    """J_space is turned into the hand's axes, but v is still that of the point at the
    world's origin => J_space in the hand's axes"""
    return turned(J_space, T[:3, :3].T)


@row.wrong
def transposed_adjoint(J_space, T):
    """this is Ad(T) transposed; the inverse of an adjoint is not its transpose => the
    Jacobian with that transpose"""
    return adjoint(T).T @ J_space


@row.wrong
def turned_by_R(J_space, T):
    """J_site is turned by R, which leads from the hand's axes to the world's; the way
    back is R^T => J_site turned by R"""
    return turned(site_jacobian(J_space, T[:3, 3]), T[:3, :3])

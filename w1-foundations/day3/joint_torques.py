"""3.7 `joint_torques(J_space, p, F)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.row import Row
from robo47.jacobian import joint_torques, site_jacobian

from .jacobians import JOINTS

row = Row(Vector((7,), "N m", names=JOINTS))


@row.inputs
def _(rng):
    """The docstring's, then drawn ones."""
    spin = np.zeros((6, 7))
    spin[2, 0] = 1.0
    first = (spin, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0, 0, -10, 0, 0]))
    drawn = draw.numbers(rng, -1, 1, 9, 6, 7)
    points, wrenches = (draw.numbers(rng, -1, 1, 9, n) for n in (3, 6))
    return [first, *zip(drawn, points, wrenches, strict=True)]


@row.wrong
def at_the_origin(J_space, p, F):
    """J_space^T goes with a wrench about the world's origin; this one is about p => the
    torques with J_space for J_site"""
    return J_space.T @ F


@row.wrong
def what_balances_it(J_space, p, F):
    """the sign is that of a world which pushes the hand; here the hand pushes, so the
    power of the motors is that of F => its negative"""
    return -joint_torques(J_space, p, F)


@row.wrong
def pseudo_inverse(J_space, p, F):
    """this is J^+ F, which is good for velocities: the motors' power is then not the
    hand's. Write both powers down => J^+ F"""
    return np.linalg.pinv(site_jacobian(J_space, p)) @ F


@row.wrong
def halves_swapped(J_space, p, F):
    """the force is taken for the moment, and the moment for the force: F is (moment;
    force), as J is (omega; v) => the torques with F's halves swapped"""
    return joint_torques(J_space, p, np.roll(F, 3))


@row.wrong
def moment_forgotten(J_space, p, F):
    """the moment is left out: its power is moment . omega => the torques of the force
    alone"""
    return site_jacobian(J_space, p)[3:].T @ F[3:]


@row.wrong
def force_forgotten(J_space, p, F):
    """the force is left out: its power is force . v => the torques of the moment
    alone"""
    return J_space[:3].T @ F[:3]


@row.wrong
def arm_the_wrong_way(J_space, p, F):
    """the moment of the force about the origin is p x f, not f x p => the torques with
    -p for p"""
    return joint_torques(J_space, -p, F)


@row.wrong
def arm_twice(J_space, p, F):
    """p x f is added to the moment, and the Jacobian is that of p already: one of the
    two => the torques with both"""
    moment = F[:3] + np.cross(p, F[3:])
    return joint_torques(J_space, p, np.append(moment, F[3:]))

"""3.2 `site_jacobian(J_space, p)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Jacobian, draw
from labkit.judge.row import Row
from robo47.screws import skew

# On these questions one thing with two names: the numbers are the same.
row = Row(Jacobian(), alike=[{"omega-changed", "halves-read-as-v-omega"}])


@row.inputs
def _(rng):
    spin = np.zeros((6, 7))
    spin[2] = 1.0
    drawn = draw.numbers(rng, -1, 1, 8, 6, 7)
    points = draw.numbers(rng, -1, 1, 8, 3)
    return [(spin, np.array([1.0, 0.0, 0.0])), *zip(drawn, points, strict=True)]


@row.wrong
def space_for_site(J_space, p):
    """this is J_space still: its v is the velocity at the world's origin, not at p =>
    J_space itself"""
    return J_space.copy()


@row.wrong
def cross_sign(J_space, p):
    """the sign of the cross product is wrong: a spin about z takes (1, 0, 0) to +y =>
    the Jacobian with v - omega x p"""
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v + skew(p) @ omega])


@row.wrong
def v_dropped(J_space, p):
    """v is only omega x p; the v that J_space has is left out => the Jacobian with
    omega x p alone"""
    omega = J_space[:3]
    return np.vstack([omega, np.cross(omega, p, axis=0)])


@row.wrong
def halves_read_as_v_omega(J_space, p):
    """the upper rows of J_space are taken for v, and the lower ones for omega => the
    Jacobian with the halves read the other way"""
    v, omega = J_space[:3], J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])


@row.wrong
def v_cross_p(J_space, p):
    """v x p is added, where omega x p belongs => the Jacobian with v + v x p"""
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v + np.cross(v, p, axis=0)])


@row.wrong
def omega_changed(J_space, p):
    """omega is changed by v x p; all points of a body have the same omega => the
    Jacobian with the cross product above"""
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega + np.cross(v, p, axis=0), v])


@row.wrong("shape")  # The three rows of v alone.
def _(J_space, p):
    return J_space[3:] + np.cross(J_space[:3], p, axis=0)


@row.wrong("rows-swapped")  # Right, but (v; omega), as MuJoCo's jacp above its jacr.
def _(J_space, p):
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])

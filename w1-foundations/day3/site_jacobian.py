"""3.2 `site_jacobian(J_space, p)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Jacobian, Row

# On these questions one thing with two names: the numbers are the same.
row = Row(Jacobian(), alike=[{"omega-changed", "halves-read-as-v-omega"}])


@row.inputs
def _(rng):
    spin = np.zeros((6, 7))
    spin[2] = 1.0
    drawn = rng.numbers(-1, 1, 8, 6, 7)
    points = rng.numbers(-1, 1, 8, 3)
    return [(spin, np.array([1.0, 0.0, 0.0])), *zip(drawn, points, strict=True)]


@row.wrongs
def _(J_space, p):
    """space-for-site: this is J_space still: its v is the velocity at the world's
      origin, not at p => J_space itself
    cross-sign: the sign of the cross product is wrong: a spin about z takes (1, 0, 0)
      to +y => the Jacobian with v - omega x p
    v-dropped: v is only omega x p; the v that J_space has is left out => the Jacobian
      with omega x p alone
    halves-read-as-v-omega: the upper rows of J_space are taken for v, and the lower
      ones for omega => the Jacobian with the halves read the other way
    v-cross-p: v x p is added, where omega x p belongs => the Jacobian with v + v x p
    omega-changed: omega is changed by v x p; all points of a body have the same omega
      => the Jacobian with the cross product above
    """
    omega = J_space[:3]
    v = J_space[3:]
    omega_p, v_p = (np.cross(half, p, axis=0) for half in (omega, v))
    halves = {
        "space-for-site": (omega, v),
        "cross-sign": (omega, v - omega_p),
        "v-dropped": (omega, omega_p),
        "halves-read-as-v-omega": (omega + v_p, v),
        "v-cross-p": (omega, v + v_p),
        "omega-changed": (omega + v_p, v),
    }
    return {slug: np.vstack(both) for slug, both in halves.items()}


@row.wrong("shape")  # The three rows of v alone.
def _(J_space, p):
    return J_space[3:] + np.cross(J_space[:3], p, axis=0)


@row.wrong("rows-swapped")  # Right, but (v; omega), as MuJoCo's jacp above its jacr.
def _(J_space, p):
    omega = J_space[:3]
    v = J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])

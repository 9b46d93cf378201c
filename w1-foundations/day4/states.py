"""States of the Panda that Day 4 asks about: in motion, and with gravity from any side.

Arrays and floats only. The truth about them is `robo47.dynamics`, which is tested
against MuJoCo, Pinocchio and the textbook's package.
"""

from functools import cache

import numpy as np

from labkit.judge import Matrix, Vector, rounded
from robo47 import dynamics, panda

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TWIST = ("omega_x", "omega_y", "omega_z", "v_x", "v_y", "v_z")
TORQUE = Vector((7,), "N m", names=JOINTS)
SIX = Matrix((6, 6), rows=TWIST, columns=TWIST)
DOWN = np.array([0.0, 0.0, -9.81])


@cache
def arm():
    """Return the Panda, as Days 1 to 4 describe it."""
    return panda.arm(panda.load("panda_nohand"))


def hinge(axis, mass):
    """Return J, G, masses and centres of one hinge with a mass at (1, 0, 0).

    The other six joints and links are there, and are nothing.
    """
    J = np.zeros((6, 7))
    masses = np.zeros(7)
    coms = np.zeros((7, 3))
    J[:3, 0] = axis
    masses[0] = mass
    coms[0] = (1.0, 0.0, 0.0)
    return J, dynamics.spatial_inertia(masses, coms, np.zeros((7, 3, 3))), masses, coms


def states(rng, n=10):
    """Return the Panda at random configurations."""
    return [arm().at(q) for q in rng.configurations(n)]


def pulls(rng, n=10):
    """Return gravity as it is, then as on a table that was tipped over."""
    return [DOWN] * (n // 2) + list(rng.numbers(-10, 10, n - n // 2, 3))


def solids(rng, *shape):
    """Return inertia matrices of solid bodies, (*shape, 3, 3)."""
    A = rng.uniform(-0.4, 0.4, (*shape, 3, 3))
    P = A @ np.swapaxes(A, -1, -2)  # of points: the integral of r r^T
    trace = np.trace(P, axis1=-2, axis2=-1)[..., None, None]
    return rounded(trace * np.eye(3) - P)


def motions(rng):
    """Return J, G, qd, qdd and g: the pendulum of task 4.4, then the Panda."""
    J, G, _, _ = hinge([0.0, 1.0, 0.0], 1.0)
    qd, qdd = rng.numbers(-2, 2, 10, 7), rng.numbers(-10, 10, 10, 7)
    parts = zip(states(rng), qd, qdd, pulls(rng), strict=True)
    pendulum = (J, G, np.zeros(7), np.eye(7)[0], DOWN)
    return [pendulum, *((now.J_space, now.G, v, a, g) for now, v, a, g in parts)]

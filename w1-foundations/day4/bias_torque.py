"""4.6 `bias_torque(J_space, G, qd, g)`: questions, mistakes, the recursion's too."""

from functools import partial

import numpy as np

from labkit.judge import Row
from robo47.dynamics import ad, inverse_dynamics, mass_matrix

from .states import TORQUE, motions

# One thing with two names: at qdd = 0 the numbers are the same.
row = Row(TORQUE, alike=[{"nothing-added-outwards", "velocities-not-added"}])
STILL = np.zeros(7)


@row.inputs
def _(rng):
    return [(J, G, qd, g) for J, G, qd, _, g in motions(rng)]


# What that one says of its inside, said of the call: it is right when this is judged.
@row.wrongs(redone="the torque so")
def _(J, G, qd, g):
    """base-acceleration-sign: gravity has the wrong sign, as if g were given as -g;
      inverse_dynamics wants g as it is
    gravity-forgotten: gravity is missing, as if g were given as 0; it is part of the
      bias
    gravity-twice: gravity counts twice; inverse_dynamics has it already
    gravity-only: qd is not used: Coriolis and centrifugal forces are missing
    coriolis-twice: Coriolis and centrifugal forces count twice; gravity is right
    coriolis-half: only half of the Coriolis and centrifugal forces is there; gravity is
      right
    speed-for-acceleration: qd is given as the acceleration, too; that has to be 0
    speed-in-place-of-acceleration: qd is given as the acceleration, and 0 as the speed
    acceleration-of-one: the acceleration is 1 for every joint; it has to be 0
    damping-added: the damping's 1.0 qd is in it; MuJoCo keeps it apart, and so does 4.8
    """
    given = {
        "base-acceleration-sign": (qd, STILL, -g),
        "gravity-forgotten": (qd, STILL, 0 * g),
        "gravity-twice": (qd, STILL, 2 * g),
        "speed-for-acceleration": (qd, qd, g),
        "speed-in-place-of-acceleration": (STILL, qd, g),
        "acceleration-of-one": (qd, np.ones(7), g),
    }
    holding, tau = (inverse_dynamics(J, G, v, STILL, g) for v in (STILL, qd))
    return {
        **{slug: partial(inverse_dynamics, J, G, *one) for slug, one in given.items()},
        "gravity-only": holding,
        "coriolis-twice": 2 * tau - holding,
        "coriolis-half": (holding + tau) / 2,
        "damping-added": tau + qd,
    }


row.reached_by(
    "inverse_dynamics",
    but=[
        "base-acceleration-sign",
        "gravity-forgotten",
        "gravity-twice",
        "speed-and-acceleration-swapped",
        "acceleration-ignored",
        "speed-ignored",
        "gravity-only",
        "armature-added",
        "damping-added",
        "armature-and-damping-added",
    ],
)


@row.wrong
def rate_of_the_mass_matrix(J, G, qd, g):
    """the rate of M times qd is not the Coriolis torque: half of what it holds belongs
    there"""
    X = ad(np.cumsum(J * qd, axis=1).T)  # of each link
    J_rate = np.array([X_i @ S for X_i, S in zip(X, J.T)]).T
    G_rate = np.array([-X_i.T @ G_i - G_i @ X_i for X_i, G_i in zip(X, G)])
    up = mass_matrix(J + J_rate, G, 0.0)
    down = mass_matrix(J - J_rate, G, 0.0)
    M_rate = 0.5 * (up - down) + mass_matrix(J, G_rate, 0.0)
    return inverse_dynamics(J, G, STILL, STILL, g) + M_rate @ qd

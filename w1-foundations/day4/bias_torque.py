"""4.6 `bias_torque(J, G, qd, g)`: its questions; its mistakes, and the recursion's."""

from functools import partial

import numpy as np

from labkit.judge.row import Row
from robo47.dynamics import inverse_dynamics, mass_matrix
from robo47.screws import ad

from .states import TORQUE, motions

# One thing with two names: at qdd = 0 the numbers are the same.
row = Row(TORQUE, alike=[{"nothing-added-outwards", "velocities-not-added"}])
wrong = partial(row.wrong, redone="the torque so")
STILL = np.zeros(7)


@row.inputs
def _(rng):
    return [(J, G, qd, g) for J, G, qd, _, g in motions(rng)]


# What that one says of its inside, said of the call: it is right when this is judged.
@wrong()
def base_acceleration_sign(J, G, qd, g):
    """gravity has the wrong sign, as if g were given as -g; inverse_dynamics wants g as
    it is"""
    return inverse_dynamics(J, G, qd, STILL, -g)


@wrong()
def gravity_forgotten(J, G, qd, g):
    """gravity is missing, as if g were given as 0; it is part of the bias"""
    return inverse_dynamics(J, G, qd, STILL, 0 * g)


@wrong("gravity-twice", "gravity counts twice; inverse_dynamics has it already")
def _(J, G, qd, g):
    return inverse_dynamics(J, G, qd, STILL, 2 * g)


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


@wrong("gravity-only", "qd is not used: Coriolis and centrifugal forces are missing")
def _(J, G, qd, g):
    return inverse_dynamics(J, G, STILL, STILL, g)


@wrong()
def coriolis_twice(J, G, qd, g):
    """Coriolis and centrifugal forces count twice; gravity is right"""
    holding = inverse_dynamics(J, G, STILL, STILL, g)
    return 2 * inverse_dynamics(J, G, qd, STILL, g) - holding


@wrong()
def coriolis_half(J, G, qd, g):
    """only half of the Coriolis and centrifugal forces is there; gravity is right"""
    holding = inverse_dynamics(J, G, STILL, STILL, g)
    return 0.5 * (holding + inverse_dynamics(J, G, qd, STILL, g))


@wrong()
def speed_for_acceleration(J, G, qd, g):
    """qd is given as the acceleration, too; that has to be 0"""
    return inverse_dynamics(J, G, qd, qd, g)


@wrong()
def speed_in_place_of_acceleration(J, G, qd, g):
    """qd is given as the acceleration, and 0 as the speed"""
    return inverse_dynamics(J, G, STILL, qd, g)


@wrong("acceleration-of-one", "the acceleration is 1 for every joint; it has to be 0")
def _(J, G, qd, g):
    return inverse_dynamics(J, G, qd, np.ones(7), g)


@wrong()
def rate_of_the_mass_matrix(J, G, qd, g):
    """the rate of M times qd is not the Coriolis torque: half of what it holds belongs
    there"""
    X = ad(np.cumsum(J * qd, axis=1).T)  # of each link
    J_rate = np.array([X_i @ S for X_i, S in zip(X, J.T)]).T
    G_rate = np.array([-X_i.T @ G_i - G_i @ X_i for X_i, G_i in zip(X, G)])
    up, down = mass_matrix(J + J_rate, G, 0.0), mass_matrix(J - J_rate, G, 0.0)
    M_rate = 0.5 * (up - down) + mass_matrix(J, G_rate, 0.0)
    return inverse_dynamics(J, G, STILL, STILL, g) + M_rate @ qd


@wrong()
def damping_added(J, G, qd, g):
    """the damping's 1.0 qd is in it; MuJoCo keeps it apart, and so does 4.8"""
    return inverse_dynamics(J, G, qd, STILL, g) + qd

"""4.6 `bias_torque(J_space, G, qd, g)`: questions, mistakes, the recursion's too."""

import numpy as np

from labkit.judge import Row
from robo47.dynamics import ad, inverse_dynamics, mass_matrix

from .states import TORQUE, motions

row = Row(TORQUE)
STILL = np.zeros(7)


@row.inputs
def _(rng):
    return [(J, G, qd, g) for J, G, qd, _, g in motions(rng)]


# Of the call alone: inverse_dynamics is correct when this function is judged.
@row.wrongs
def _(J, G, qd, g):
    """coriolis-twice: your gravity torque is correct, but your Coriolis and centrifugal
      torques are twice the correct values. Does your code add a velocity term twice?
    coriolis-half: your gravity torque is correct, but your Coriolis and centrifugal
      torques are half the correct values. Does your code omit a velocity term, or halve
      their sum?
    speed-in-place-of-acceleration: your result is the torque for the acceleration qd
      and the velocity 0. Use qd as the velocity and 0 as the acceleration
    gravity-left-out: your result omits the gravity torque, so it contains only the
      Coriolis and centrifugal torques. The bias contains the gravity torque as well
    velocity-left-out: your result is only the gravity torque. The bias contains the
      Coriolis and centrifugal torques as well, which depend on qd
    damping-added: your code adds the damping torque (1.0 qd). Omit this torque, because
      MuJoCo and task 4.8 treat it separately
    """
    holding, tau = (inverse_dynamics(J, G, v, STILL, g) for v in (STILL, qd))
    return {
        "coriolis-twice": 2 * tau - holding,
        "coriolis-half": (holding + tau) / 2,
        "speed-in-place-of-acceleration": inverse_dynamics(J, G, STILL, qd, g),
        "gravity-left-out": inverse_dynamics(J, G, qd, STILL, 0 * g),
        "velocity-left-out": holding,
        "damping-added": tau + qd,
    }


row.reached_by(
    "inverse_dynamics",
    but=[
        "base-acceleration-sign",
        "gravity-only",
        "armature-added",
        "damping-added",
        "armature-and-damping-added",
    ],
)


@row.wrong
def rate_of_the_mass_matrix(J, G, qd, g):
    """your Coriolis and centrifugal torques are only dM/dt qd. Also subtract the
    gradient of the kinetic energy with respect to q, as in Lagrange's equations"""
    X = ad(np.cumsum(J * qd, axis=1).T)  # of each link
    J_rate = np.array([X_i @ S for X_i, S in zip(X, J.T)]).T
    G_rate = np.array([-X_i.T @ G_i - G_i @ X_i for X_i, G_i in zip(X, G)])
    up = mass_matrix(J + J_rate, G, 0.0)
    down = mass_matrix(J - J_rate, G, 0.0)
    M_rate = 0.5 * (up - down) + mass_matrix(J, G_rate, 0.0)
    return inverse_dynamics(J, G, STILL, STILL, g) + M_rate @ qd

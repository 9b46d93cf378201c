"""States of the Panda that Day 6 asks about: J, M and Lambda, rounded, that fit."""

from functools import cache

import numpy as np

from labkit.judge import Twist, Vector, Wrench, rounded
from robo47 import panda, task_space

SIGMA = 0.1  # least singular value of J: nearer to a singularity digits are lost
COUNT = 9  # drawn calls of each function, after the docstring's case
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TORQUE = Vector((7,), "N m", scale=10.0, names=JOINTS)
WRENCH = Wrench(scale=10.0)
J_CASE = np.eye(6, 7)
M_CASE = np.eye(7)
SWAP = [3, 4, 5, 0, 1, 2]


class Acceleration(Twist):
    """Of the hand: angular, then linear."""

    halves = ("the angular half", "the linear half")


@cache
def _arm():
    return panda.arm(panda.load("panda_nohand"))


def states(rng):
    """Return COUNT configurations of the Panda, each worked out by `robo47.arm`."""
    found = []
    while len(found) < COUNT:
        now = _arm().at(rng.configurations(1)[0])
        if np.linalg.svd(now.J_site, compute_uv=False)[-1] > SIGMA:
            found.append(now)
    return found


def model(now):
    """Return J and M, rounded, and their Lambda: all three must fit together."""
    J, M = rounded(now.J_site), rounded(now.M)
    return J, M, task_space.task_inertia(J, M)


def some(rng, reach, *shape):
    """Return numbers between -reach and reach, rounded."""
    return rng.numbers(-reach, reach, *shape)


def springs(rng):
    """Return errors, twists, stiffness and damping."""
    e = np.zeros(6)
    K = np.diag([30.0, 30.0, 30.0, 400.0, 400.0, 400.0])
    case = (np.array([0, 0, 0, 0, 0, 0.025]), np.zeros(6), K, np.eye(6))
    drawn = []
    for now in states(rng):
        D = rounded(task_space.critical_damping(np.diag(K), model(now)[2]))
        e = np.append(some(rng, 0.5, 3), some(rng, 0.05, 3))
        stiffness = np.diag(rng.numbers(10, 500, 6))
        V_err = some(rng, 0.5, 6)
        coupled = np.triu(some(rng, 50, 6, 6), 1)
        # D need not be symmetric: from which side it is taken then shows.
        drawn.append((e, V_err, stiffness + coupled + coupled.T, D + coupled))
    e, V_err, K, D = drawn[0]
    near = (0.001 * e, 0.001 * V_err, K, D)
    far = (10.0 * e, V_err, K, D)
    return [case, near, far, *drawn]

"""4.9 `energy(M, qd, masses, coms_world, g)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47 import panda
from robo47.dynamics import energy

from .gravity import OTHER_GRAVITY
from .states import DOWN, arm, pulls, states

row = Row(Vector((2,), "J", names=("the kinetic energy", "the potential energy")))


@row.inputs
def _(rng):
    M = np.diag([2.0, 0, 0, 0, 0, 0, 0])
    qd = 3.0 * np.eye(7)[0]
    yield M, qd, np.zeros(7), np.zeros((7, 3)), DOWN
    ready = arm().at(panda.READY_Q)
    yield ready.M, np.zeros(7), arm().masses, ready.coms_world, DOWN
    moving = zip(states(rng), rng.numbers(-2, 2, 10, 7), pulls(rng), strict=True)
    for now, v, g in moving:
        yield now.M, v, arm().masses, now.coms_world, g


@row.wrongs
def _(M, qd, masses, coms_world, g):
    """speed-squared-too-early: your kinetic energy contains the product of M and the
      squared entries of qd. The kinetic energy should contain qd on both sides of M, as
      in qd^T M qd
    every-mass-everywhere: your code multiplies the height of each link by the mass of
      the whole arm. Multiply by the mass of that link instead
    distance-for-height: your code uses the distance between the origin and each centre
      of mass as the height. Use the component of the position along `-g` instead
    """
    K, U = energy(M, qd, masses, coms_world, g)
    all_at_once = -coms_world.sum(axis=0) @ g  # of 1 kg at each centre
    far = np.linalg.norm(coms_world, axis=1)
    both = {
        "speed-squared-too-early": (0.5 * np.sum(M @ qd**2), U),
        "every-mass-everywhere": (K, masses.sum() * all_at_once),
        "distance-for-height": (K, masses @ far * np.sqrt(g @ g)),
    }
    return {slug: np.array(one) for slug, one in both.items()}


row.of_argument("g", *OTHER_GRAVITY)


@row.wrong("few-entries-off", hidden="nothing is at rest there")  # No energy at rest.
def _(M, qd, masses, coms_world, g):
    return energy(M, qd, masses, coms_world, g) if qd.any() else np.zeros(2)


row.at_least_0(masses="a mass")

"""What Day 4's functions are asked, and what a right answer is.

The truth comes from `robo47.dynamics` (tested against MuJoCo, Pinocchio and the
textbook's package), never from the lab script. Arrays and floats only: the Panda at
random configurations, and gravity that does not point down.
"""

from functools import cache

import numpy as np

from labkit.judge import Ask, Matrix, Symmetric, Vector, draw
from labkit.judge.kinds import Kind
from labkit.judge.mistake import each
from robo47 import dynamics, panda, screws

from .mistakes.bias import BIAS_TORQUE
from .mistakes.bodies import SPATIAL_INERTIA
from .mistakes.brackets import AD
from .mistakes.energy import ENERGY
from .mistakes.forces import INVERSE_DYNAMICS
from .mistakes.forward import FORWARD_DYNAMICS
from .mistakes.gravity import GRAVITY_TORQUE
from .mistakes.links import LINK_INERTIAS
from .mistakes.mass import MASS_MATRIX

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TWIST = ("omega x", "omega y", "omega z", "v x", "v y", "v z")
DOWN = np.array([0.0, 0.0, -9.81])
AT_ONE_METRE = np.array([1.0, 0.0, 0.0])
NEAR = 1e-5  # further off is wrong, not only rounded


@cache
def _arm():
    return panda.arm(panda.load("panda_nohand"))


def _hinge(axis, mass):
    """Return J, G, masses and centres of one hinge with a mass at (1, 0, 0).

    The other six joints and links are there, and are nothing.
    """
    J, masses, coms = np.zeros((6, 7)), np.zeros(7), np.zeros((7, 3))
    J[:3, 0], masses[0], coms[0] = axis, mass, AT_ONE_METRE
    return J, dynamics.spatial_inertia(masses, coms, np.zeros((7, 3, 3))), masses, coms


def _states(rng, n=10):
    """Return the Panda at random configurations."""
    return [_arm().at(q) for q in draw.configurations(rng, n)]


def _pulls(rng, n=10):
    """Return gravity as it is, then as on a table that was tipped over."""
    return [DOWN] * (n // 2) + list(draw.numbers(rng, -10, 10, n - n // 2, 3))


def _bodies(rng):
    """Return 2 kg at (0, 0, 1), then what a machine's parts may be like."""
    point = (2.0, np.array([0.0, 0.0, 1.0]), np.zeros((3, 3)))
    masses, coms = draw.numbers(rng, 0.2, 5, 9), draw.numbers(rng, -1, 1, 9, 3)
    return [point, *zip(map(float, masses), coms, _solids(rng, 9), strict=True)]


def _solids(rng, *shape):
    """Return inertia matrices of solid bodies, (*shape, 3, 3)."""
    A = rng.uniform(-0.4, 0.4, (*shape, 3, 3))
    P = A @ np.swapaxes(A, -1, -2)  # of points: the integral of r r^T
    trace = np.trace(P, axis1=-2, axis2=-1)[..., None, None]
    return draw.rounded(trace * np.eye(3) - P)


def _links(rng):
    """Return links that nobody has turned, the Panda's, then those of no robot."""
    still = np.tile(np.eye(4), (7, 1, 1))
    arm = _arm()
    body = (arm.masses, arm.coms, arm.inertias)
    own = [(still, *body), *((now.T_links, *body) for now in _states(rng, 5))]
    others = [
        (draw.poses(rng, 7), draw.numbers(rng, 0.2, 5, 7),
         draw.numbers(rng, -0.5, 0.5, 7, 3), _solids(rng, 7))
        for _ in range(4)
    ]  # fmt: skip
    return own + others


def _masses(rng):
    J, G, _, _ = _hinge([0.0, 0.0, 1.0], 2.0)
    rotors = [np.full(7, 0.1)] * 5 + list(draw.numbers(rng, 0.02, 0.3, 5, 7))
    states = zip(_states(rng), rotors, strict=True)
    return [(J, G, rotors[0]), *((now.J_space, now.G, a) for now, a in states)]


def _weights(rng):
    J, _, masses, coms = _hinge([0.0, 1.0, 0.0], 1.0)
    pulls = zip(_states(rng), _pulls(rng), strict=True)
    at = [(now.J_space, _arm().masses, now.coms_world, g) for now, g in pulls]
    return [(J, masses, coms, DOWN), *at]


def _twists(rng):
    case, shift = np.eye(6)[2] + np.eye(6)[3], np.array([0, 0, 0, 0.3, -0.2, 0.5])
    return [(V,) for V in (case, shift, *draw.numbers(rng, -2, 2, 9, 6))]


def _motions(rng):
    J, G, _, _ = _hinge([0.0, 1.0, 0.0], 1.0)
    qd, qdd = draw.numbers(rng, -2, 2, 10, 7), draw.numbers(rng, -10, 10, 10, 7)
    parts = zip(_states(rng), qd, qdd, _pulls(rng), strict=True)
    pendulum = (J, G, np.zeros(7), np.eye(7)[0], DOWN)
    return [pendulum, *((now.J_space, now.G, v, a, g) for now, v, a, g in parts)]


def _speeds(rng):
    return [(J, G, qd, g) for J, G, qd, _, g in _motions(rng)]


def _pushed(rng):
    """Return the Panda held up, let go; then in motion, with any torque.

    In half of the motions a load pulls as hard as the motors can, or harder: the bias
    holds it, and tau, so that no acceleration gets out of hand.
    """
    case, *states = _states(rng, 11)
    zero = np.zeros(7)
    still = (case.M, case.gravity_torque, np.ones(7), zero)
    qd = draw.numbers(rng, -2, 2, 10, 7)
    tau = draw.numbers(rng, -10, 10, 10, 7)
    limits = np.array([87.0] * 4 + [12.0] * 3)
    load = draw.rounded(1.5 * limits * rng.uniform(-1, 1, (10, 7)))
    load[:5] = 0.0
    damping = [np.ones(7)] * 5 + list(draw.numbers(rng, 0.1, 3, 5, 7))
    parts = zip(states, damping, qd, tau, load, strict=True)
    return [
        (*still, case.gravity_torque),
        (*still, zero),
        *((now.M, now.bias(v) + w, D, v, t + w) for now, D, v, t, w in parts),
    ]


def _energies(rng):
    M, qd = np.diag([2.0, 0, 0, 0, 0, 0, 0]), 3.0 * np.eye(7)[0]
    case = (M, qd, np.zeros(7), np.zeros((7, 3)), DOWN)
    parts = zip(_states(rng), draw.numbers(rng, -2, 2, 10, 7), _pulls(rng), strict=True)
    arm = _arm()
    ready = arm.at(draw.READY)
    still = (ready.M, np.zeros(7), arm.masses, ready.coms_world, DOWN)
    moving = ((now.M, v, arm.masses, now.coms_world, g) for now, v, g in parts)
    return [case, still, *moving]


def _ask(inputs, kind, truth, mistakes) -> Ask:
    return Ask(inputs, kind, truth=truth, mistakes=mistakes, near=NEAR)


TORQUE = Vector((7,), "N m", names=JOINTS)
SIX = Matrix((6, 6), rows=TWIST, columns=TWIST)

QUESTIONS = {
    "spatial_inertia": _ask(_bodies, SIX, dynamics.spatial_inertia, SPATIAL_INERTIA),
    "link_inertias": _ask(
        _links, Kind((7, 6, 6)), each(dynamics.link_inertias), LINK_INERTIAS
    ),
    "mass_matrix": _ask(
        _masses, Symmetric((7, 7), "kg m2"), each(dynamics.mass_matrix), MASS_MATRIX
    ),
    "gravity_torque": _ask(
        _weights, TORQUE, each(dynamics.gravity_torque), GRAVITY_TORQUE
    ),
    "ad": _ask(_twists, SIX, screws.ad, AD),
    "inverse_dynamics": _ask(
        _motions, TORQUE, each(dynamics.inverse_dynamics), INVERSE_DYNAMICS
    ),
    "bias_torque": _ask(_speeds, TORQUE, each(dynamics.bias_torque), BIAS_TORQUE),
    "forward_dynamics": _ask(
        _pushed,
        Vector((7,), "rad/s2", names=JOINTS),
        dynamics.forward_dynamics,
        FORWARD_DYNAMICS,
    ),
    "energy": _ask(
        _energies,
        Vector((2,), "J", names=("the kinetic", "the potential")),
        each(dynamics.energy),
        ENERGY,
    ),
}

# One thing with two names: at qdd = 0 the numbers are the same.
ALIKE = {"bias_torque": [{"nothing-added-outwards", "velocities-not-added"}]}

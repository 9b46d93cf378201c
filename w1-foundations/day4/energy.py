"""4.9 `energy(M, qd, masses, coms_world, g)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.row import Row
from robo47.dynamics import energy

from .gravity import other_gravity
from .states import DOWN, arm, pulls, states

row = Row(Vector((2,), "J", names=("the kinetic", "the potential")))


@row.inputs
def _(rng):
    M, qd = np.diag([2.0, 0, 0, 0, 0, 0, 0]), 3.0 * np.eye(7)[0]
    yield M, qd, np.zeros(7), np.zeros((7, 3)), DOWN
    ready = arm().at(draw.READY)
    yield ready.M, np.zeros(7), arm().masses, ready.coms_world, DOWN
    moving = zip(states(rng), draw.numbers(rng, -2, 2, 10, 7), pulls(rng), strict=True)
    for now, v, g in moving:
        yield now.M, v, arm().masses, now.coms_world, g


@row.wrong
def half_forgotten(M, qd, masses, coms_world, g):
    """the kinetic energy has no 1/2 => the answer with twice as much"""
    return energy(2 * M, qd, masses, coms_world, g)


@row.wrong
def potential_sign(M, qd, masses, coms_world, g):
    """the potential energy has the wrong sign: g points down, and what is lifted gains
    => the answer with that sign"""
    return energy(M, qd, masses, coms_world, -g)


@row.wrong
def diagonal_only(M, qd, masses, coms_world, g):
    """the kinetic energy takes only the diagonal of M; the joints share their links =>
    the answer with the diagonal"""
    return energy(np.diag(np.diag(M)), qd, masses, coms_world, g)


@row.wrong
def speed_squared_too_early(M, qd, masses, coms_world, g):
    """qd is squared before M is applied; qd stands on both sides of M => the answer
    with M qd^2"""
    return np.array([0.5 * np.sum(M @ qd**2), -masses @ coms_world @ g])


@row.wrong
def mass_matrix_forgotten(M, qd, masses, coms_world, g):
    """the kinetic energy takes no mass: M is missing => the answer with qd.qd / 2"""
    return energy(np.eye(7), qd, masses, coms_world, g)


@row.wrong
def masses_forgotten(M, qd, masses, coms_world, g):
    """the potential energy takes no masses => the answer with 1 kg each"""
    return energy(M, qd, np.ones(7), coms_world, g)


@row.wrong
def every_mass_everywhere(M, qd, masses, coms_world, g):
    """every link's centre is multiplied by the whole arm's mass => the answer with the
    total mass"""
    return energy(M, qd, np.full(7, masses.sum()), coms_world, g)


@row.wrong
def order_swapped(M, qd, masses, coms_world, g):
    """potential energy comes first; kinetic was asked for first => the two swapped"""
    return energy(M, qd, masses, coms_world, g)[::-1]


row.of_argument("g", *other_gravity("the answer with that gravity"))


@row.wrong("few-entries-off", hidden="nothing is at rest there")  # No energy at rest.
def _(M, qd, masses, coms_world, g):
    return energy(M, qd, masses, coms_world, g) if qd.any() else np.zeros(2)

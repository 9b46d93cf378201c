"""7.9 `heaviest_cube(grip, mu, acceleration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Scalar, draw
from labkit.judge.row import Row

G = 9.81

row = Row(Scalar(unit="kg", scale=0.1))


@row.inputs
def _(rng):
    drawn = draw.numbers(rng, 0.1, 1.0, 9, 3) * [8.0, 1.5, 4.0]
    down = [(6.0, 1.4, -2.5), (3.0, 0.5, -6.0)]
    return [(0.9247, 1.0, 0.0), *down, *map(tuple, draw.rounded(drawn).tolist())]


@row.wrong
def one_finger(grip, mu, acceleration):
    """one finger's friction is missing: two faces hold the cube => half of it"""
    return mu * grip / (G + acceleration)


@row.wrong
def acceleration_forgotten(grip, mu, acceleration):
    """the cube's acceleration does not count; while it speeds up it needs more => the
    mass at rest"""
    return 2 * mu * grip / G


@row.wrong
def acceleration_sign(grip, mu, acceleration):
    """the acceleration is taken off gravity; upwards it comes on top => the mass with g
    - a"""
    return 2 * mu * grip / (G - acceleration)


@row.wrong
def gravity_forgotten(grip, mu, acceleration):
    """gravity is missing: at rest nothing would have to be lifted => the mass without
    gravity"""
    return np.divide(2 * mu * grip, acceleration)


@row.wrong
def weight_for_mass(grip, mu, acceleration):
    """this is the force in newtons; the mass is that force over g + a => the friction's
    force"""
    return 2 * mu * grip


@row.wrong
def friction_forgotten(grip, mu, acceleration):
    """friction does not count; without mu nothing is lifted => the mass with mu = 1"""
    return 2 * grip / (G + acceleration)


@row.wrong
def divided_by_friction(grip, mu, acceleration):
    """the friction mu stands below the line; more friction lifts more => the mass with
    1 / mu"""
    return 2 * grip / (mu * (G + acceleration))


@row.wrong
def gravity_negative(grip, mu, acceleration):
    """gravity has the wrong sign here: its z is -9.81, and it pulls down => the mass
    with -9.81"""
    return 2 * mu * grip / (acceleration - G)


@row.wrong
def acceleration_without_sign(grip, mu, acceleration):
    """the acceleration's sign is lost: downwards, it takes weight off the fingers =>
    the mass with |a|"""
    return 2 * mu * grip / (G + abs(acceleration))


@row.wrong
def acceleration_without_sign(grip, mu, acceleration):
    """an acceleration downwards does not count; it takes weight off the fingers => the
    mass with max(a, 0)"""
    return 2 * mu * grip / (G + max(acceleration, 0.0))


for g in (9.8, 10, 9.80665):

    @row.wrong(
        "another-gravity",
        f"gravity is {g} m/s2 here; the lab's GRAVITY says 9.81",
        f"the mass with {g}",
    )
    def _(grip, mu, acceleration, g=g):
        return 2 * mu * grip / (g + acceleration)

"""2.9 `dh_link(alpha, a, d, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.argument_mistakes import NEGATED
from robo47 import se3
from robo47.screws import dh_link

from .arms import FRANKA

row = Row(
    Pose(
        wrong_way="maps the previous link's coordinates to the next link's coordinates"
    )
)


@row.inputs
def _(rng):
    yield np.pi / 2, 0.0, 0.316, 0.0
    yield (*map(float, FRANKA[3]), 0.4)
    yield (*map(float, FRANKA[4]), -1.3)
    yield from (tuple(map(float, one)) for one in rng.numbers(-1.5, 1.5, 7, 4))


def in_order(order, alpha, a, d, theta):
    """Return the four moves in an order: x, z turn; X, Z move along.

    Craig's order is "xXzZ", the other convention's "zZXx".
    """
    I, still = np.eye(3), np.zeros(3)  # noqa: E741
    moves = {
        "x": se3.make_T(se3.Rx(alpha), still),
        "X": se3.make_T(I, [a, 0.0, 0.0]),
        "z": se3.make_T(se3.Rz(theta), still),
        "Z": se3.make_T(I, [0.0, 0.0, d]),
    }
    T = np.eye(4)
    for move in order:
        T = T @ moves[move]
    return T


@row.wrongs
def _(alpha, a, d, theta):
    """standard-formula: your code uses the standard convention, Rot_z Trans_z Trans_x
      Rot_x. Franka's table follows Craig's convention, so the rotation about x and
      the translation along x should come first
    a-after-theta: your code translates by `a` after the rotation about z. The
      translation by `a` should come before this rotation
    d-along-the-old-z: your code translates by `d` before the rotation about x. The
      translation by `d` should come after this rotation
    order-of-moves: your matrix is the product of the four correct factors in the wrong
      order. The translation by `a` belongs next to the rotation about x. The
      translation by `d` belongs next to the rotation about z
    """
    orders = {
        "standard-formula": "zZXx",
        "a-after-theta": "xzXZ",
        "d-along-the-old-z": "ZxXz",
        "order-of-moves": "ZxzX",
    }
    return {
        slug: partial(in_order, o, alpha, a, d, theta) for slug, o in orders.items()
    }


for order in ("zxXZ", "XzxZ", "XzZx"):
    row.wrong(
        "order-of-moves",
        "your code rotates about z before it rotates about x. The rotation about x and "
        "the translation along x should come before the rotation about z",
    )(partial(in_order, order))


@row.wrongs
def _(alpha, a, d, theta):
    """both-turns-backwards: your code rotates by -alpha and by -theta. The correct
      rotations are by alpha and by theta themselves
    radians-taken-for-degrees: your code converts both angles from degrees to radians.
      Use both angles unchanged, because they are already in radians
    alpha-forgotten: your code does not use the argument `alpha`
    theta-forgotten: your code does not use the argument `theta`
    """
    instead = {
        "both-turns-backwards": (-alpha, a, d, -theta),
        "radians-taken-for-degrees": (np.deg2rad(alpha), a, d, np.deg2rad(theta)),
        "alpha-forgotten": (0.0, a, d, theta),
        "theta-forgotten": (alpha, a, d, 0.0),
    }
    return {slug: partial(dh_link, *four) for slug, four in instead.items()}


for name in ("alpha", "a", "d", "theta"):
    row.of_argument(name, NEGATED)


@row.wrong("slip-sign")  # One minus forgotten.
def _(alpha, a, d, theta):
    T = dh_link(alpha, a, d, theta)
    T[1, 3] *= -1
    return T


row.spans(  # as small, or as large, as in the lab
    theta=(0.013,),
)

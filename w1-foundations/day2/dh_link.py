"""2.9 `dh_link(alpha, a, d, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from labkit.judge.argument_mistakes import NEGATED, RADIANS_TWICE
from robo47 import se3
from robo47.screws import dh_link

from .arms import FRANKA

row = Row(Pose())


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
    """standard-formula: this is the other convention, Rz Tz Tx Rx; Craig's turns about
      x first, and Franka's table is written for his => the other convention's matrix
    a-after-theta: the rotation is right, but a is moved along the x axis after the turn
      about z; it comes before it => the right one with that order
    d-along-the-old-z: the rotation is right, but d is moved along the z axis before the
      turn about x => the right one with that order
    order-of-moves: the four moves are right, but not their order
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
        "the turn about z stands before the turn about x; the link's twist comes first",
        "the product in that order",
    )(partial(in_order, order))


@row.wrongs
def _(alpha, a, d, theta):
    """a-and-d-swapped: the two lengths a and d have changed places: a is along x, d
      along z => the right one with the two swapped
    alpha-and-theta-swapped: alpha and theta have changed places: alpha turns about x,
      theta about z => the right one with the two swapped
    both-turns-backwards: both turns go the wrong way => the right one with -alpha and
      -theta
    radians-taken-for-degrees: the angles are in radians already, and are converted from
      degrees once more => the right one with smaller angles
    alpha-forgotten: alpha has no effect => the right one with alpha = 0
    theta-forgotten: theta has no effect => the right one with theta = 0
    """
    instead = {
        "a-and-d-swapped": (alpha, d, a, theta),
        "alpha-and-theta-swapped": (theta, a, d, alpha),
        "both-turns-backwards": (-alpha, a, d, -theta),
        "radians-taken-for-degrees": (np.deg2rad(alpha), a, d, np.deg2rad(theta)),
        "alpha-forgotten": (0.0, a, d, theta),
        "theta-forgotten": (alpha, a, d, 0.0),
    }
    return {slug: partial(dh_link, *four) for slug, four in instead.items()}


row.of_argument("alpha", NEGATED, RADIANS_TWICE)
for name in ("a", "d", "theta"):
    row.of_argument(name, NEGATED)
row.of_answer(of_a_pose("maps the link before to this one"))


@row.wrong("slip-sign")  # One minus forgotten.
def _(alpha, a, d, theta):
    T = dh_link(alpha, a, d, theta)
    T[1, 3] *= -1
    return T


row.spans(  # as small, or as large, as in the lab
    theta=(0.013,),
)

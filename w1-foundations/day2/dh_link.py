"""2.9 `dh_link(alpha, a, d, theta)`: its questions and its mistakes."""

from dataclasses import replace

import numpy as np

from labkit.judge import Pose, draw
from labkit.judge.argument_mistakes import DEGREES, NEGATED, Change
from labkit.judge.finished import of_a_pose
from labkit.judge.row import Row
from robo47 import se3
from robo47.screws import dh_link

from .arms import FRANKA

row = Row(Pose())


@row.inputs
def _(rng):
    yield np.pi / 2, 0.0, 0.316, 0.0
    yield (*map(float, FRANKA[3]), 0.4)
    yield (*map(float, FRANKA[4]), -1.3)
    yield from (tuple(map(float, one)) for one in draw.numbers(rng, -1.5, 1.5, 7, 4))


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


@row.wrong
def standard_formula(alpha, a, d, theta):
    """this is the other convention, Rz Tz Tx Rx; Craig's turns about x first, and
    Franka's table is written for his => the other convention's matrix"""
    return in_order("zZXx", alpha, a, d, theta)


@row.wrong
def a_after_theta(alpha, a, d, theta):
    """the rotation is right, but a is moved along the x axis after the turn about z; it
    comes before it => the right one with that order"""
    return in_order("xzXZ", alpha, a, d, theta)


@row.wrong
def d_along_the_old_z(alpha, a, d, theta):
    """the rotation is right, but d is moved along the z axis before the turn about x =>
    the right one with that order"""
    return in_order("ZxXz", alpha, a, d, theta)


for order in ("zxXZ", "XzxZ", "XzZx"):

    @row.wrong(
        "order-of-moves",
        "the turn about z stands before the turn about x; the link's twist comes first",
        "the product in that order",
    )
    def _(alpha, a, d, theta, order=order):
        return in_order(order, alpha, a, d, theta)


@row.wrong
def order_of_moves(alpha, a, d, theta):
    """the four moves are right, but not their order => the product in that order"""
    return in_order("ZxzX", alpha, a, d, theta)


@row.wrong
def a_and_d_swapped(alpha, a, d, theta):
    """the two lengths a and d have changed places: a is along x, d along z => the right
    one with the two swapped"""
    return dh_link(alpha, d, a, theta)


@row.wrong
def alpha_and_theta_swapped(alpha, a, d, theta):
    """alpha and theta have changed places: alpha turns about x, theta about z => the
    right one with the two swapped"""
    return dh_link(theta, a, d, alpha)


@row.wrong
def both_turns_backwards(alpha, a, d, theta):
    """both turns go the wrong way => the right one with -alpha and -theta"""
    return dh_link(-alpha, a, d, -theta)


@row.wrong
def radians_taken_for_degrees(alpha, a, d, theta):
    """the angles are in radians already, and are converted from degrees once more =>
    the right one with smaller angles"""
    return dh_link(np.deg2rad(alpha), a, d, np.deg2rad(theta))


for name, says in (
    ("alpha", "alpha turns the wrong way"),
    ("theta", "theta turns the wrong way"),
    ("a", "the length a is taken the wrong way along x"),
    ("d", "the length d is taken the wrong way along z"),
):
    row.of_argument(name, replace(NEGATED, slug=f"{name}-sign", says=says))
for name in ("alpha", "theta"):
    row.of_argument(
        name,
        Change(
            f"{name}-forgotten",
            f"{name} has no effect",
            np.zeros_like,
            f"the right one with {name} = 0",
        ),
    )
row.of_argument(
    "alpha",
    replace(
        DEGREES,
        slug="radians-taken-for-degrees",
        says="alpha is in radians already, and is converted from degrees once more",
        redone="the right one with a smaller alpha",
    ),
)
row.of_answer(of_a_pose("maps the link before to this one"))


@row.wrong("few-entries-off")  # One minus forgotten.
def _(alpha, a, d, theta):
    T = dh_link(alpha, a, d, theta)
    T[1, 3] *= -1
    return T

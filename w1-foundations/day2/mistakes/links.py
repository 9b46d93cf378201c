"""Mistakes in task 2.9: `dh_link(alpha, a, d, theta)`."""

import numpy as np

from labkit.judge.finished import of_a_pose
from labkit.judge.matrices import pose
from labkit.judge.mistake import Mistake, applied
from robo47 import se3
from robo47.checks import Array

from .moves import Function

ORDER = "xXzZ"  # Craig's: turn about x, move along x, turn about z, move along z


def link(alpha: Array, a: Array, d: Array, theta: Array, order: str = ORDER) -> Array:
    """Return the four moves in an order, (..., 4, 4): x, z turn; X, Z move along."""
    alpha, a, d, theta = np.broadcast_arrays(alpha, a, d, theta)
    moves = {
        "x": pose(se3.Rx(alpha), np.zeros(3)),
        "X": pose(np.eye(3), a[..., None] * [1.0, 0.0, 0.0]),
        "z": pose(se3.Rz(theta), np.zeros(3)),
        "Z": pose(np.eye(3), d[..., None] * [0.0, 0.0, 1.0]),
    }
    T = np.eye(4)
    for move in order:
        T = T @ moves[move]
    return T


def _in_order(order: str) -> Function:
    return lambda alpha, a, d, theta: link(alpha, a, d, theta, order)


DH_LINK = [
    Mistake(
        "standard-formula",
        "this is the other convention, Rz Tz Tx Rx; Craig's turns about x first, and "
        "Franka's table is written for his",
        _in_order("zZXx"),
        "the other convention's matrix",
    ),
    Mistake(
        "a-after-theta",
        "the rotation is right, but a is moved along the x axis after the turn about "
        "z; it comes before it",
        _in_order("xzXZ"),
        "the right one with that order",
    ),
    Mistake(
        "d-along-the-old-z",
        "the rotation is right, but d is moved along the z axis before the turn about "
        "x",
        _in_order("ZxXz"),
        "the right one with that order",
    ),
    *(
        Mistake(
            "order-of-moves",
            "the turn about z stands before the turn about x; the link's twist comes "
            "first",
            _in_order(order),
            "the product in that order",
        )
        for order in ("zxXZ", "XzxZ", "XzZx")
    ),
    Mistake(
        "order-of-moves",
        "the four moves are right, but not their order",
        _in_order("ZxzX"),
        "the product in that order",
    ),
    Mistake(
        "a-and-d-swapped",
        "the two lengths a and d have changed places: a is along x, d along z",
        lambda alpha, a, d, theta: link(alpha, d, a, theta),
        "the right one with the two swapped",
    ),
    Mistake(
        "alpha-and-theta-swapped",
        "alpha and theta have changed places: alpha turns about x, theta about z",
        lambda alpha, a, d, theta: link(theta, a, d, alpha),
        "the right one with the two swapped",
    ),
    Mistake(
        "alpha-sign",
        "alpha turns the wrong way",
        lambda alpha, a, d, theta: link(-alpha, a, d, theta),
        "the right one with -alpha",
    ),
    Mistake(
        "theta-sign",
        "theta turns the wrong way",
        lambda alpha, a, d, theta: link(alpha, a, d, -theta),
        "the right one with -theta",
    ),
    Mistake(
        "both-turns-backwards",
        "both turns go the wrong way",
        lambda alpha, a, d, theta: link(-alpha, a, d, -theta),
        "the right one with -alpha and -theta",
    ),
    Mistake(
        "a-sign",
        "the length a is taken the wrong way along x",
        lambda alpha, a, d, theta: link(alpha, -a, d, theta),
        "the right one with -a",
    ),
    Mistake(
        "d-sign",
        "the length d is taken the wrong way along z",
        lambda alpha, a, d, theta: link(alpha, a, -d, theta),
        "the right one with -d",
    ),
    Mistake(
        "alpha-forgotten",
        "alpha has no effect",
        lambda alpha, a, d, theta: link(0.0 * alpha, a, d, theta),
        "the right one with alpha = 0",
    ),
    Mistake(
        "theta-forgotten",
        "theta has no effect",
        lambda alpha, a, d, theta: link(alpha, a, d, 0.0 * theta),
        "the right one with theta = 0",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "the angles are in radians already, and are converted from degrees once more",
        lambda alpha, a, d, theta: link(np.deg2rad(alpha), a, d, np.deg2rad(theta)),
        "the right one with smaller angles",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "alpha is in radians already, and is converted from degrees once more",
        lambda alpha, a, d, theta: link(np.deg2rad(alpha), a, d, theta),
        "the right one with a smaller alpha",
    ),
    *applied(of_a_pose("maps the link before to this one"), link),
]

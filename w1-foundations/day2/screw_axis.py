"""2.3 `screw_axis(axis, point)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Twist, draw
from labkit.judge.row import Row
from robo47.screws import screw_axis

from . import halves

row = Row(Twist(), unnamed=halves.turned_round)


@row.inputs
def _(rng):
    axes = [np.array([0.0, 0.0, 1.0]), *np.eye(3), *draw.units(rng, 5)]
    points = [np.array([1.0, 0.0, 0.0]), *draw.numbers(rng, -1, 1, 8, 3)]
    return zip(axes, points, strict=True)


@row.wrong(
    "moment-sign",
    "omega is right, but v has the wrong sign: it is the velocity of the origin as "
    "seen from the axis, and the arrow from your point to the origin is -point",
    "the right one with v = +omega x point",
)
def _(axis, point):
    return np.append(axis, np.cross(axis, point))


@row.wrong(
    "moment-is-point",
    "v is the point itself; it has to be a velocity, which depends on omega too",
    "(omega; point)",
)
def _(axis, point):
    return np.append(axis, point)


@row.wrong(
    "moment-is-minus-point",
    "v is minus the point; it has to be a velocity, which depends on omega too",
    "(omega; -point)",
)
def _(axis, point):
    return np.append(axis, -point)


@row.wrong(
    "moment-forgotten",
    "v is 0, so the axis goes through the origin, wherever the point is",
    "(omega; 0)",
)
def _(axis, point):
    return np.append(axis, np.zeros(3))


@row.wrong(
    "twist-order", "the two halves are swapped: omega comes first, then v", "(v; omega)"
)
def _(axis, point):
    return np.append(np.cross(point, axis), axis)


@row.wrong(
    "twist-order-and-sign",
    "two things: the halves are swapped, omega comes first; and v has the wrong sign",
    "(omega x point; omega)",
)
def _(axis, point):
    return np.append(np.cross(axis, point), axis)


@row.wrong(
    "product-by-entries",
    "v is omega times the point entry by entry; a cross product mixes the entries",
    "(omega; -omega * point)",
)
def _(axis, point):
    return np.append(axis, -axis * point)


@row.wrong(
    "product-by-entries",
    "v is omega times the point entry by entry; a cross product mixes the entries",
    "(omega; omega * point)",
)
def _(axis, point):
    return np.append(axis, axis * point)


@row.wrong(
    "divided-by-its-length",
    "all six numbers are divided by their length; omega alone is of length 1, and it "
    "comes so",
    "the right one so divided",
)
def _(axis, point):
    S = screw_axis(axis, point)
    return S / np.linalg.norm(S)


@row.wrong(
    "axis-reversed",
    "the whole screw is negated: it turns about the same line, the other way",
    "the screw of -axis",
)
def _(axis, point):
    return -screw_axis(axis, point)


@row.wrong(
    "omega-reversed",
    "v is right, but omega is -axis",
    "the right one with omega negated",
)
def _(axis, point):
    return np.append(-axis, np.cross(point, axis))


@row.close("rounded")  # Rounded for reading.
def _(axis, point):
    return np.round(np.hstack([axis, -np.cross(axis, point)]), 6)

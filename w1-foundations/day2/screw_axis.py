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


@row.wrong
def moment_sign(axis, point):
    """omega is right, but v has the wrong sign: it is the velocity of the origin as
    seen from the axis, and the arrow from your point to the origin is -point => the
    right one with v = +omega x point"""
    return np.append(axis, np.cross(axis, point))


@row.wrong
def moment_is_point(axis, point):
    """v is the point itself; it has to be a velocity, which depends on omega too =>
    (omega; point)"""
    return np.append(axis, point)


@row.wrong
def moment_is_minus_point(axis, point):
    """v is minus the point; it has to be a velocity, which depends on omega too =>
    (omega; -point)"""
    return np.append(axis, -point)


@row.wrong
def moment_forgotten(axis, point):
    """v is 0, so the axis goes through the origin, wherever the point is => (omega;
    0)"""
    return np.append(axis, np.zeros(3))


@row.wrong
def twist_order(axis, point):
    """the two halves are swapped: omega comes first, then v => (v; omega)"""
    return np.append(np.cross(point, axis), axis)


@row.wrong
def twist_order_and_sign(axis, point):
    """two things: the halves are swapped, omega comes first; and v has the wrong sign
    => (omega x point; omega)"""
    return np.append(np.cross(axis, point), axis)


for sign, minus in ((-1, "-"), (1, "")):
    row.wrong(
        "product-by-entries",
        "v is omega times the point entry by entry; a cross product mixes the entries",
        f"(omega; {minus}omega * point)",
    )(lambda axis, point, sign=sign: np.append(axis, sign * axis * point))


@row.wrong
def divided_by_its_length(axis, point):
    """all six numbers are divided by their length; omega alone is of length 1, and it
    comes so => the right one so divided"""
    S = screw_axis(axis, point)
    return S / np.linalg.norm(S)


@row.wrong
def axis_reversed(axis, point):
    """the whole screw is negated: it turns about the same line, the other way => the
    screw of -axis"""
    return -screw_axis(axis, point)


@row.wrong
def omega_reversed(axis, point):
    """v is right, but omega is -axis => the right one with omega negated"""
    return np.append(-axis, np.cross(point, axis))


@row.close("rounded")  # Rounded for reading.
def _(axis, point):
    return np.round(np.hstack([axis, -np.cross(axis, point)]), 6)


@row.wrong("axis-turned-round")  # Every axis is made to point the positive way.
def _(axis, point):
    sign = np.sign(axis[np.argmax(np.abs(axis))])
    return screw_axis(sign * axis, point)

"""2.3 `screw_axis(axis, point)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Twist
from robo47.screws import screw_axis

from . import halves

row = Row(Twist(), unnamed=halves.turned_round)


@row.inputs
def _(rng):
    axes = [np.array([0.0, 0.0, 1.0]), *np.eye(3), *rng.units(5)]
    points = [np.array([1.0, 0.0, 0.0]), *rng.numbers(-1, 1, 8, 3)]
    return zip(axes, points, strict=True)


@row.wrongs
def _(axis, point):
    """moment-sign: omega is right, but v has the wrong sign: it is the velocity of the
      origin as seen from the axis, and the arrow from your point to the origin is
      -point => the right one with v = +omega x point
    moment-is-point: v is the point itself; it has to be a velocity, which depends on
      omega too => (omega; point)
    moment-is-minus-point: v is minus the point; it has to be a velocity, which depends
      on omega too => (omega; -point)
    moment-is-foot: v is the point of the axis that is nearest to the origin; it has to
      be a velocity, at right angles to it => (omega; that point)
    moment-forgotten: v is 0, so the axis goes through the origin, wherever the point is
      => (omega; 0)
    twist-order: the two halves are swapped: omega comes first, then v => (v; omega)
    twist-order-and-sign: two things: the halves are swapped, omega comes first; and v
      has the wrong sign => (omega x point; omega)
    divided-by-its-length: all six numbers are divided by their length; omega alone is
      of length 1, and it comes so => the right one so divided
    axis-reversed: the whole screw is negated: it turns about the same line, the other
      way => the screw of -axis
    product-by-entries: v is omega times the point entry by entry; a cross product mixes
      the entries => (omega; -omega * point)
    product-by-entries 2: v is omega times the point entry by entry; a cross product
      mixes the entries => (omega; omega * point)
    omega-reversed: v is right, but omega is -axis => the right one with omega negated
    axis-added: the axis is added to v: that screw moves along itself as it turns, and a
      hinge does not => the right one with v + omega
    """
    right = screw_axis(axis, point)
    v = np.cross(point, axis)
    return {
        "moment-sign": np.append(axis, -v),
        "moment-is-point": np.append(axis, point),
        "moment-is-minus-point": np.append(axis, -point),
        "moment-is-foot": np.append(axis, point - point @ axis * axis),
        "moment-forgotten": np.append(axis, np.zeros(3)),
        "twist-order": np.append(v, axis),
        "twist-order-and-sign": np.append(-v, axis),
        "divided-by-its-length": right / np.linalg.norm(right),
        "axis-reversed": -right,
        "product-by-entries": np.append(axis, -axis * point),
        "product-by-entries 2": np.append(axis, axis * point),
        "omega-reversed": np.append(-axis, v),
        "axis-added": np.append(axis, v + axis),
    }


@row.close("rounded")  # Rounded for reading.
def _(axis, point):
    return np.round(np.hstack([axis, -np.cross(axis, point)]), 6)


@row.wrong("axis-turned-round")  # Every axis is made to point the positive way.
def _(axis, point):
    sign = np.sign(axis[np.argmax(np.abs(axis))])
    return screw_axis(sign * axis, point)


row.spans(  # as small, or as large, as in the lab
    point=(lambda point: 0.3 * point,),
)

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
    """moment-sign: your omega is correct, but v has the wrong sign. The velocity v is
      the velocity of the origin, and the vector from your point to the origin is -point
    moment-is-point: your v is the point itself, but v should be a velocity, which
      depends on omega as well
    moment-is-minus-point: your v is the negative of the point, but v should be a
      velocity, which depends on omega as well
    moment-is-foot: your v is the point of the axis nearest to the origin, but v should
      be a velocity, which is perpendicular to that point
    moment-forgotten: your v is 0 for every point, which is correct only for an axis
      through the origin
    twist-order: your two halves are swapped. The first half should be omega, the second
      half v
    twist-order-and-sign: your halves are swapped, because omega comes first, and v has
      the wrong sign
    product-by-entries: your v is the product of omega and the point entry by entry. Use
      the cross product
    product-by-entries 2: your v is the product of omega and the point entry by entry.
      Use the cross product
    """
    v = np.cross(point, axis)
    return {
        "moment-sign": np.append(axis, -v),
        "moment-is-point": np.append(axis, point),
        "moment-is-minus-point": np.append(axis, -point),
        "moment-is-foot": np.append(axis, point - point @ axis * axis),
        "moment-forgotten": np.append(axis, np.zeros(3)),
        "twist-order": np.append(v, axis),
        "twist-order-and-sign": np.append(-v, axis),
        "product-by-entries": np.append(axis, -axis * point),
        "product-by-entries 2": np.append(axis, axis * point),
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

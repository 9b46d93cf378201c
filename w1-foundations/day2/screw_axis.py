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
    """moment-sign: your omega is correct, but your v has the wrong sign. The vector v
      should be omega x r, where r is the vector from the point on the axis to the
      origin
    moment-is-point: your code uses the point on the axis as v. The vector v should be
      the velocity of the body-fixed point at the origin, which depends on both omega
      and the point on the axis
    moment-is-minus-point: your code uses the negative of the point on the axis as v.
      The vector v should be the velocity of the body-fixed point at the origin, which
      depends on both omega and the point on the axis
    moment-is-foot: your v is the position of the point on the axis that is nearest to
      the origin. The vector v should be the velocity of the body-fixed point at the
      origin. This velocity is perpendicular to your v
    moment-forgotten: your v is always 0, which is correct only for an axis through the
      origin. Compute v from the axis and the point
    twist-order: your code swaps omega and v. The first half of the screw should be
      omega, and the second half should be v
    twist-order-and-sign: your code swaps omega and v, and your v also has the wrong
      sign. The first half of the screw should be omega
    product-by-entries: your code computes v as an entry-by-entry product of omega and
      the point. Use the cross product instead
    product-by-entries 2: your code computes v as an entry-by-entry product of omega and
      the point. Use the cross product instead
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

"""46.1 `angle_between(a, b)`: one number, in radians."""

import numpy as np

from labkit.judge import Row, Scalar

from .pairs import pairs


def angle(a, b):
    """Return the angle, right."""
    return np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)


row = Row(Scalar(unit="rad"), truth=angle, near=1e-4)
row.inputs(pairs)


@row.wrong
def in_degrees(a, b):
    """the angle is in degrees; here it is in radians"""
    return np.rad2deg(angle(a, b))

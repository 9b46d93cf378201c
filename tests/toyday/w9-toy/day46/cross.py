"""46.2 `cross(a, b)`: a vector."""

import numpy as np

from labkit.judge import Row, Vector

from .pairs import pairs

row = Row(Vector((3,)), truth=np.cross, near=1e-4)
row.inputs(pairs)


@row.wrong
def b_cross_a(a, b):
    """the two factors are swapped: this is b x a"""
    return np.cross(b, a)

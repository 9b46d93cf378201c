"""46.3 `spin(omega)`: a matrix, made with `cross`."""

import numpy as np

from labkit.judge import Matrix, Row

from .pairs import skew, vectors


def both(w):
    """Return diag([w], [w]), right."""
    out = np.zeros((6, 6))
    out[:3, :3] = out[3:, 3:] = skew(w)
    return out


row = Row(Matrix((6, 6)), truth=both, near=1e-4)
row.inputs(vectors)


@row.wrong
def second_half_empty(omega):
    """the lower right block is empty; v turns too"""
    out = both(omega)
    out[3:, 3:] = 0.0
    return out


row.reached_by("cross", "in cross, ")

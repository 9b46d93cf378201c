"""46.4 `bracket(V)`: a matrix without named mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .pairs import skew, vectors


def right(V):
    """Return [V]."""
    out = np.zeros((4, 4))
    out[:3, :3], out[:3, 3] = skew(V[:3]), V[3:]
    return out


row = Row(Matrix((4, 4)), truth=right, near=1e-4)
row.inputs(lambda rng: vectors(rng, 6))

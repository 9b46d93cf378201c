"""3.2 `site_jacobian(J_space, p)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Jacobian, Row

# On these questions one thing with two names: the numbers are the same.
row = Row(Jacobian())


@row.inputs
def _(rng):
    spin = np.zeros((6, 7))
    spin[2] = 1.0
    drawn = rng.numbers(-1, 1, 8, 6, 7)
    points = rng.numbers(-1, 1, 8, 3)
    return [(spin, np.array([1.0, 0.0, 0.0])), *zip(drawn, points, strict=True)]


@row.wrongs
def _(J_space, p):
    """space-for-site: your code returns J_space, whose v is the velocity of the
      body-fixed point at the world origin. Use the velocity of the point p instead
    omega-changed: your code adds v x p to the upper rows, as if these were v. The upper
      rows are omega, which is the same for all points of a body, so change only the
      lower rows
    """
    omega = J_space[:3]
    v = J_space[3:]
    v_p = np.cross(v, p, axis=0)
    halves = {
        "space-for-site": (omega, v),
        "omega-changed": (omega + v_p, v),
    }
    return {slug: np.vstack(both) for slug, both in halves.items()}


@row.wrong("shape")  # The three rows of v alone.
def _(J_space, p):
    return J_space[3:] + np.cross(J_space[:3], p, axis=0)


@row.wrong("rows-swapped")  # Right, but (v; omega), as MuJoCo's jacp above its jacr.
def _(J_space, p):
    omega = J_space[:3]
    v = J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])

"""14.2 `grasp_matrix(points, centre)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.grasp import grasp_matrix
from robo47.screws import skew

row = Row(Matrix((6, None), rows=("mx", "my", "mz", "fx", "fy", "fz")))


@row.inputs
def _(rng):
    yield np.array([[0, 0.02, 0], [0, -0.02, 0]]), np.zeros(3)
    yield rng.numbers(-1, 1, 1, 3), np.zeros(3)
    yield rng.numbers(-1, 1, 3, 3), np.zeros(3)
    for n in (1, 2, 3, 4, 5):
        yield rng.numbers(-1, 1, n, 3), rng.numbers(-1, 1, 3)


def stacked(blocks):
    """Return a block row of matrices."""
    return np.hstack(list(blocks))


@row.wrongs
def _(points, centre):
    """centre-forgotten: your code computes the moments about the origin of the world
      frame. Compute them about the argument `centre`
    moment-sign: your code negates the moments. The moment of a force f at the point p
      should be (p - `centre`) x f
    halves-swapped: your code swaps the force rows and the moment rows. Put the moment
      rows above the force rows
    arm-on-the-diagonal: your code puts `p - c` on the diagonal. Use the skew-symmetric
      matrix of `p - c` instead, because the moment is a cross product
    added-up: your code returns a single block with the sum of all lever arms. Give each
      point its own three columns instead
    components-together: your code groups the columns by component, with all x
      components first. Put the three columns of each contact next to each other
    moments-only: your code leaves the lower three rows at 0. Put the forces into these
      rows
    forces-only: your code leaves the upper three rows at 0. Put the moments into these
      rows
    about-the-mean: your code computes the moments about the mean of the points. Compute
      them about the argument `centre`
    forces-negative: your code negates the forces. The force rows of each contact should
      be the identity matrix
    forces-over-n: your code divides the forces by the number of points. Omit this
      division
    """
    arms = points - centre
    one = np.eye(3)
    pad = (len(points), 3, 3)
    right = grasp_matrix(points, centre)

    def made(arms, force=one):
        return stacked([np.vstack([skew(a), force]) for a in arms])

    return {
        "centre-forgotten": made(points),
        "moment-sign": made(-arms),
        "halves-swapped": np.vstack([right[3:], right[:3]]),
        "arm-on-the-diagonal": stacked([np.vstack([np.diag(a), one]) for a in arms]),
        "added-up": lambda: np.vstack([skew(arms.sum(axis=0)), one]),
        "components-together": right.reshape(6, *pad[:2]).swapaxes(1, 2).reshape(6, -1),
        "moments-only": made(arms, 0 * one),
        "forces-only": made(0 * arms),
        "about-the-mean": made(points - points.mean(axis=0)),
        "forces-negative": made(arms, -one),
        "forces-over-n": made(arms, one / len(points)),
    }


@row.right  # Column by column: a unit force along each axis, its moment by np.cross.
def _(points, centre):
    columns = []
    for p in points:
        for axis in np.eye(3):
            columns.append(np.append(np.cross(p - centre, axis), axis))
    return np.array(columns).T


row.spans(  # as small, or as large, as in the lab
    centre=(lambda centre: 0.05 * centre,),
)

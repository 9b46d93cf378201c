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
    """centre-forgotten: moments are about the world's origin; they are about the centre
      => with p for p - c
    centre-for-arm: the arm is the centre alone, not p - c
    moment-sign: the moments have the wrong sign: the arm is p - c, not c - p, and its
      matrix is not transposed
    centre-added: the arm is p + c; it goes from the centre to the point, p - c
    halves-swapped: it is (force; moment); a wrench is (moment; force) => with the upper
      and the lower three rows swapped
    arm-on-the-diagonal: p - c stands on the diagonal; a cross product has it beside the
      diagonal, as skew writes it
    added-up: there is one block for all points; each point has three columns of its own
    components-together: the columns are all x, all y, all z; those of a point stand
      together
    moments-only: the forces are missing: the lower three rows are 0
    forces-only: the moments are missing: the upper three rows are 0
    about-the-mean: moments are about the points' mean, not about the centre
    last-point-first: the points stand in reverse order
    first-point-for-all: all blocks are the first point's
    forces-negative: the forces stand with a minus: it is what the cube does to the
      fingers
    forces-over-n: the forces are divided by the number of points
    """
    arms = points - centre
    one = np.eye(3)
    pad = (len(points), 3, 3)
    right = grasp_matrix(points, centre)

    def made(arms, force=one):
        return stacked([np.vstack([skew(a), force]) for a in arms])

    return {
        "centre-forgotten": made(points),
        "centre-for-arm": made(np.tile(centre, (len(points), 1))),
        "moment-sign": made(-arms),
        "centre-added": made(points + centre),
        "halves-swapped": np.vstack([right[3:], right[:3]]),
        "arm-on-the-diagonal": stacked([np.vstack([np.diag(a), one]) for a in arms]),
        "added-up": lambda: np.vstack([skew(arms.sum(axis=0)), one]),
        "components-together": right.reshape(6, *pad[:2]).swapaxes(1, 2).reshape(6, -1),
        "moments-only": made(arms, 0 * one),
        "forces-only": made(0 * arms),
        "about-the-mean": made(points - points.mean(axis=0)),
        "last-point-first": made(arms[::-1]),
        "first-point-for-all": made(np.tile(arms[:1], (len(points), 1))),
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

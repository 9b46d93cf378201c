"""4.1 `spatial_inertia(m, c, inertia)`: its questions and its mistakes."""
# ruff: noqa: E741 (I is what the field calls an inertia)

import numpy as np

from labkit.judge import Row
from robo47.screws import skew

from .states import SIX, solids

row = Row(SIX)
ONE = np.eye(3)
NONE = np.zeros((3, 3))


@row.inputs
def _(rng):
    point = (2.0, np.array([0.0, 0.0, 1.0]), np.zeros((3, 3)))
    masses = rng.numbers(0.2, 5, 9)
    coms = rng.numbers(-1, 1, 9, 3)
    return [point, *zip(map(float, masses), coms, solids(rng, 9))]


def of_blocks(a, b, c, d):
    """Return the matrix of four blocks, row by row."""
    return np.block([[a, b], [c, d]])


@row.wrongs
def _(m, c, I):
    """parallel-axis-forgotten: the top left block is about the centre of mass still:
      what the distance to the origin adds is missing => the matrix with I alone there
    parallel-axis-sign: in the top left block the distance makes the body lighter to
      turn: [c] [c] is the negative of [c] [c]^T => the matrix with I + m [c] [c]
    outer-product-for-skew: the top left block has c c^T instead of [c] [c]^T: a mass is
      hard to turn about the axes that it is far from => the matrix with I + m c c^T
    distance-in-all-directions: the top left block has |c|^2 for all three axes; a
      distance along an axis does not count for that axis => the matrix with I + m |c|^2
    distance-counts-twice: the top left block adds m [c] [c]^T twice; the 1/2 of the
      energy does not stand in the matrix, so it needs no 2 => the matrix with I + 2 m
      [c] [c]^T
    entry-by-entry: the top left block multiplies [c] and [c]^T entry by entry, with *;
      the product of two matrices is @ => the matrix with * there
    mass-forgotten-in-the-parallel-axis: the top left block adds [c] [c]^T without the
      mass => the matrix without m there
    own-inertia-forgotten: the body's own inertia I is missing: this is a point mass
    products-of-inertia-sign: the entries of I off its diagonal have the wrong sign; I
      is the matrix that it has to be, and is added as it is
    diagonal-of-I: only the diagonal of I is used; the other entries are 0 along a
      body's own axes, and these are the world's => the matrix with the rest of I as 0
    """
    C = skew(c)
    own = np.diag(np.diag(I))
    shift = m * C @ C.T
    top_left = {
        "parallel-axis-forgotten": I,
        "parallel-axis-sign": I - shift,
        "outer-product-for-skew": I + m * np.outer(c, c),
        "distance-in-all-directions": I + m * c @ c * ONE,
        "distance-counts-twice": I + 2 * shift,
        "entry-by-entry": I + m * C * C.T,
        "mass-forgotten-in-the-parallel-axis": I + C @ C.T,
        "own-inertia-forgotten": shift,
        "products-of-inertia-sign": 2 * own - I + shift,
        "diagonal-of-I": own + shift,
    }
    return {slug: of_blocks(A, m * C, m * C.T, m * ONE) for slug, A in top_left.items()}


@row.wrongs
def _(m, c, I):
    """about-the-centre-of-mass: c is not used: all of it is about the centre of mass.
      About the origin three of the four blocks hold c => the matrix with I and m on its
      diagonal and nothing else
    corners-alike: both corners are the same; one has to be the transpose of the other,
      else the matrix is not symmetric => the matrix with m [c] twice
    corners-swapped: the two corners have changed places. It is still symmetric and
      positive definite, but its angular momentum points the wrong way => the matrix
      with [c] and [c]^T swapped
    corners-empty: the two corners are empty: they tie the turning to the moving, and
      vanish only about the centre of mass => the matrix with 0 there
    one-corner-empty: the lower left corner is empty; the matrix is symmetric, so what
      stands in the upper right one says what belongs there => the matrix with 0 there
    mass-forgotten-in-the-corners: the two corners have [c] without the mass => the
      matrix without m there
    mass-forgotten-below: the lower right block is the identity, without the mass => the
      matrix with 1 for m there
    mass-everywhere: the lower right block has the mass in all nine entries; it belongs
      on the diagonal => the matrix with m in all of them
    blocks-v-omega: the blocks are in the order (v; omega); omega comes first, as in J
    """
    C = skew(c)
    M = m * ONE
    A = I + m * C @ C.T
    mC = m * C
    made = {
        "about-the-centre-of-mass": (I, NONE, NONE, M),
        "corners-alike": (A, mC, mC, M),
        "corners-swapped": (A, mC.T, mC, M),
        "corners-empty": (A, NONE, NONE, M),
        "one-corner-empty": (A, mC, NONE, M),
        "mass-forgotten-in-the-corners": (A, C, C.T, M),
        "mass-forgotten-below": (A, mC, mC.T, ONE),
        "mass-everywhere": (A, mC, mC.T, np.full((3, 3), m)),
        "blocks-v-omega": (M, mC.T, mC, A),
    }
    return {slug: of_blocks(*four) for slug, four in made.items()}


@row.wrongs
def _(m, c, I):
    """corners-alike: both corners are the same; one has to be the transpose of the
      other, else the matrix is not symmetric => the matrix with m [c]^T twice
    one-corner-empty: the upper right corner is empty; the matrix is symmetric, so what
      stands in the lower left one says what belongs there => the matrix with 0 there
    """
    mC = m * skew(c)
    A = I + mC @ skew(c).T
    M = m * ONE
    return {
        "corners-alike": of_blocks(A, mC.T, mC.T, M),
        "one-corner-empty": of_blocks(A, NONE, mC.T, M),
    }


row.at_least_0(m="a mass")


row.spans(  # as small, or as large, as in the lab
    c=(lambda c: 0.05 * c,),
    inertia=(
        lambda inertia: 0.009 * inertia,
        lambda inertia: 10 * inertia,
    ),
)

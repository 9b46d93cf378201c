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
    """parallel-axis-sign: the parallel-axis term of your upper left block has the wrong
      sign. The term is m [c] [c]^T, which equals -m [c] [c], because [c] is
      skew-symmetric
    outer-product-for-skew: your upper left block contains m c c^T instead of m [c]
      [c]^T. The moment of inertia about an axis depends on the distance from the axis,
      not on the coordinate along the axis
    distance-in-all-directions: your upper left block uses |c|^2 for all three axes. Use
      m [c] [c]^T instead, because the moment of inertia about each axis depends only on
      the distance from that axis
    products-of-inertia-sign: your code negates the off-diagonal entries of the given
      inertia matrix. Their signs are already correct, so use all entries unchanged
    """
    C = skew(c)
    own = np.diag(np.diag(I))
    shift = m * C @ C.T
    top_left = {
        "parallel-axis-sign": I - shift,
        "outer-product-for-skew": I + m * np.outer(c, c),
        "distance-in-all-directions": I + m * c @ c * ONE,
        "products-of-inertia-sign": 2 * own - I + shift,
    }
    return {slug: of_blocks(A, m * C, m * C.T, m * ONE) for slug, A in top_left.items()}


@row.wrongs
def _(m, c, I):
    """about-the-centre-of-mass: your code does not use c, so the result is the inertia
      about the centre of mass. The inertia about the origin contains c in three of its
      four blocks
    corners-alike: your two off-diagonal blocks are equal. The matrix is symmetric, so
      one block should be the transpose of the other
    corners-alike 2: your two off-diagonal blocks are equal. The matrix is symmetric, so
      one block should be the transpose of the other
    corners-swapped: your code swaps the two off-diagonal blocks. The upper right block
      should be m [c], and the lower left block should be m [c]^T
    corners-empty: your two off-diagonal blocks are 0, which is correct only for c = 0.
      The blocks should be m [c] and m [c]^T, because they couple rotation and
      translation
    one-corner-empty: one of your two off-diagonal blocks is 0. The matrix is symmetric,
      so each off-diagonal block should be the transpose of the other
    mass-forgotten-in-the-corners: your two off-diagonal blocks contain [c] without the
      mass. Multiply both blocks by the mass
    mass-everywhere: your lower right block has the mass in all nine entries. Only the
      diagonal should contain the mass
    blocks-v-omega: your blocks are in the order (v; omega). The block of omega should
      come first, as in the Jacobian
    """
    C = skew(c)
    M = m * ONE
    A = I + m * C @ C.T
    mC = m * C
    made = {
        "about-the-centre-of-mass": (I, NONE, NONE, M),
        "corners-alike": (A, mC, mC, M),
        "corners-alike 2": (A, mC.T, mC.T, M),
        "corners-swapped": (A, mC.T, mC, M),
        "corners-empty": (A, NONE, NONE, M),
        "one-corner-empty": (A, mC, NONE, M),
        "mass-forgotten-in-the-corners": (A, C, C.T, M),
        "mass-everywhere": (A, mC, mC.T, np.full((3, 3), m)),
        "blocks-v-omega": (M, mC.T, mC, A),
    }
    return {slug: of_blocks(*four) for slug, four in made.items()}


@row.right  # Without a skew-symmetric matrix of its own square.
def _(m, c, I):
    block = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])  # [c]
    about = I + m * (c @ c * np.eye(3) - np.outer(c, c))  # inertia about the origin
    corner = m * block  # the upper right block
    return np.vstack(
        [
            np.hstack([about, corner]),
            np.hstack([corner.T, m * np.eye(3)]),
        ]
    )


row.at_least_0(m="a mass")


row.spans(  # as small, or as large, as in the lab
    c=(lambda c: 0.05 * c,),
    inertia=(
        lambda inertia: 0.009 * inertia,
        lambda inertia: 10 * inertia,
    ),
)

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
    """parallel-axis-sign: the parallel-axis term of the upper left block has the wrong
      sign. It should be m [c] [c]^T, which equals -m [c] [c] because [c] is
      skew-symmetric => the matrix with I + m [c] [c]
    outer-product-for-skew: the upper left block contains c c^T instead of [c] [c]^T,
      but a mass resists rotation about the axes that are far from it => the matrix with
      I + m c c^T
    distance-in-all-directions: the upper left block uses |c|^2 for all three axes; only
      the distance from an axis contributes to the inertia about it => the matrix with I
      + m |c|^2
    products-of-inertia-sign: the off-diagonal entries of the inertia have the wrong
      sign; the argument is already the inertia matrix, so add it unchanged
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
    """about-the-centre-of-mass: c is not used, so the matrix is about the centre of
      mass; about the origin three of the four blocks contain c => the matrix with I and
      m on its diagonal and nothing else
    corners-alike: the two off-diagonal blocks are equal; the matrix is symmetric, so
      one should be the transpose of the other => the matrix with m [c] twice
    corners-alike 2: the two off-diagonal blocks are equal; the matrix is symmetric, so
      one should be the transpose of the other => the matrix with m [c]^T twice
    corners-swapped: the two off-diagonal blocks are swapped. The matrix is still
      symmetric and positive definite, but the momentum has the wrong direction => the
      matrix with [c] and [c]^T swapped
    corners-empty: the two off-diagonal blocks are 0. They couple rotation and
      translation, and are 0 only about the centre of mass => the matrix with 0 there
    one-corner-empty: one off-diagonal block is 0; the matrix is symmetric, so each of
      the two blocks is the transpose of the other => the matrix with 0 there
    mass-forgotten-in-the-corners: the two off-diagonal blocks contain [c] without the
      mass => the matrix without m there
    mass-everywhere: the lower right block has the mass in all nine entries; only the
      diagonal should contain it => the matrix with m in all of them
    blocks-v-omega: the blocks are in the order (v; omega); omega comes first, as in the
      Jacobian
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

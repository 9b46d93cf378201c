"""8.1 `spatial_inertia_from_params(phi)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Symmetric
from robo47.identification import spatial_inertia_from_params as right
from robo47.screws import skew

from .states import SWAP, bodies

row = Row(Symmetric((6, 6)))


@row.inputs
def _(rng):
    drawn = bodies(rng)
    drawn[5][0] = (
        0.0  # the unit vectors of 8.2 have no mass, and a fit may give a negative one
    )
    drawn[6:, 0] *= -1.0
    return [(np.array([2.0, 0, 0, 2, 2, 2, 0, 0, 0, 0]),), *((x,) for x in drawn)]


@row.wrongs
def _(phi):
    """products-negative: your code negates Ixy, Ixz and Iyz. Copy these three values
      unchanged, because they are already entries of the matrix I
    row-by-row: your code reads the six entries of I in the order Ixx, Ixy, Iyy, Ixz,
      Iyz, Izz. Their order in phi is Ixx, Iyy, Izz, Ixy, Ixz, Iyz
    triangle-by-rows: your code reads the six entries of I in the order Ixx, Ixy, Ixz,
      Iyy, Iyz, Izz. Their order in phi is Ixx, Iyy, Izz, Ixy, Ixz, Iyz
    first-moment-times-m: your code multiplies phi[1:4] by m. Use phi[1:4] unchanged,
      because it is already the first moment m c
    corners-swapped: your code swaps the two off-diagonal blocks. The upper right block
      should be [h] and the lower left block [h]^T
    """
    m, *h = phi[:4]
    changed = {
        "products-negative": [m, *h, *phi[4:7], *-phi[7:]],
        "row-by-row": phi[[0, 1, 2, 3, 4, 6, 9, 5, 7, 8]],
        "triangle-by-rows": phi[[0, 1, 2, 3, 4, 7, 9, 5, 6, 8]],
        "first-moment-times-m": [m, *(m * phi[1:4]), *phi[4:]],
        "corners-swapped": [m, *-phi[1:4], *phi[4:]],
    }
    return {slug: partial(right, other) for slug, other in changed.items()}


@row.wrongs
def _(phi):
    """lower-half-zero: your code writes the products of inertia Ixy, Ixz and Iyz only
      above the diagonal. Write these products below the diagonal as well, because I is
      symmetric
    inertia-about-the-centre: your code adds m [c] [c]^T to I. Use I unchanged, because
      phi already contains the inertia about the origin
    steiner-without-m: your code adds [h] [h]^T to I. Use I unchanged, because phi
      already contains the inertia about the origin
    corner-not-transposed: your code uses [h] for both off-diagonal blocks. The lower
      left block should be [h]^T
    corner-negated: your code uses [h]^T for both off-diagonal blocks. The upper right
      block should be [h]
    velocity-first: your code orders the blocks for a twist of the form (v; omega). Put
      the angular block first, because this course writes a twist as (omega; v)
    """
    G = right(phi)
    C = skew(phi[1:4])
    below = np.tril(G[:3, :3], -1)
    moved = C @ C.T / (phi[0] or np.inf)
    return {
        "lower-half-zero": G - np.pad(below, (0, 3)),
        "inertia-about-the-centre": G + np.pad(moved, (0, 3)),
        "steiner-without-m": G + np.pad(C @ C.T, (0, 3)),
        "corner-not-transposed": G + np.kron([[0.0, 0.0], [1.0, 0.0]], 2.0 * C),
        "corner-negated": G + np.kron([[0.0, 1.0], [0.0, 0.0]], -2.0 * C),
        "velocity-first": G[np.ix_(SWAP, SWAP)],
    }


@row.right  # A constant matrix for each parameter, because the matrix is linear in phi.
def _(phi):
    return np.tensordot(phi, right(np.eye(10)), axes=1)


@row.close("rounded-somewhere")  # float32 inside.
def _(phi):
    return right(phi.astype(np.float32).astype(float) + 1e-7)


row.spans(  # as small, or as large, as in the lab
    phi=(lambda phi: 0.01 * phi,),
)

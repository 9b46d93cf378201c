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
    drawn[5][0] = 0.0  # a unit vector of 8.2 has no mass, and a fit may find less
    drawn[6:, 0] *= -1.0
    return [(np.array([2.0, 0, 0, 2, 2, 2, 0, 0, 0, 0]),), *((x,) for x in drawn)]


@row.wrongs
def _(phi):
    """products-negative: Ixy, Ixz and Iyz have changed their sign; here they are the
      entries of I as they stand in it => the right one with -Ixy, -Ixz, -Iyz
    row-by-row: the six are read as Ixx, Ixy, Iyy, Ixz, Iyz, Izz, which is the order of
      other software; here the diagonal comes first => I in that order
    triangle-by-rows: the six are read as Ixx, Ixy, Ixz, Iyy, Iyz, Izz; here the
      diagonal comes first => I in that order
    products-in-another-order: the last three are read as Ixy, Iyz, Ixz; here Ixz comes
      before Iyz => the right one with those two swapped
    first-moment-times-m: phi[1:4] is multiplied by m; it is m c already, which keeps
      all of it linear => the right one with m [h] for [h]
    corners-swapped: the corners are swapped: [h] stands at the upper right, [h]^T at
      the lower left => the right one with -h
    """
    m, *h = phi[:4]
    changed = {
        "products-negative": [m, *h, *phi[4:7], *-phi[7:]],
        "row-by-row": phi[[0, 1, 2, 3, 4, 6, 9, 5, 7, 8]],
        "triangle-by-rows": phi[[0, 1, 2, 3, 4, 7, 9, 5, 6, 8]],
        "products-in-another-order": phi[[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]],
        "first-moment-times-m": [m, *(m * phi[1:4]), *phi[4:]],
        "corners-swapped": [m, *-phi[1:4], *phi[4:]],
    }
    return {slug: partial(right, other) for slug, other in changed.items()}


@row.wrongs
def _(phi):
    """lower-half-zero: the products stand above the diagonal of I only; I is symmetric
    inertia-about-the-centre: m [c] [c]^T is added to I; phi has I about the origin,
      with that in it already => the right one with I + m [c] [c]^T
    steiner-without-m: [h] [h]^T is added to I; phi has I about the origin, with all of
      that in it already => the right one with I + [h] [h]^T
    corner-not-transposed: [h] stands in both corners; the lower left one is [h]^T =>
      the right one with [h] twice
    corner-negated: [h]^T stands in both corners; the upper right one is [h] => the
      right one with [h]^T twice
    velocity-first: the blocks are in the order (v; omega); here omega comes first
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


@row.right  # One constant matrix for each number: that is what linear means.
def _(phi):
    return np.tensordot(phi, right(np.eye(10)), axes=1)


@row.close("rounded-somewhere")  # float32 inside.
def _(phi):
    return right(phi.astype(np.float32).astype(float) + 1e-7)


row.spans(  # as small, or as large, as in the lab
    phi=(lambda phi: 0.01 * phi,),
)

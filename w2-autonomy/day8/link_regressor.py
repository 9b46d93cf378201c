"""8.2 `link_regressor(V, Vd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.identification import link_regressor, spatial_inertia_from_params
from robo47.screws import ad

from .states import NUMBERS, WRENCH

row = Row(Matrix((6, 10), rows=WRENCH, columns=NUMBERS))
REST = np.zeros(6)
UP = np.array([0, 0, 0, 0, 0, 9.81])
SPIN = np.eye(6)[2]
# A unit vector has m or m c, never both, so these two mistakes do not show here.
BOTH = ["inertia-about-the-centre", "first-moment-times-m"]
row.reached_by(
    "spatial_inertia_from_params", "in `spatial_inertia_from_params`, ", but=BOTH
)


@row.inputs
def _(rng):
    drawn = rng.numbers(-3, 3, 8, 2, 6)
    return [(REST, UP), (SPIN, REST), *((V, Vd) for V, Vd in drawn)]


@row.wrongs
def _(V, Vd):
    """ad-not-transposed: your velocity term is -ad(V) G V. It should be -ad(V)^T G V,
      because the momentum G V transforms like a wrench
    ad-not-transposed-plus: your velocity term is ad(V) G V. It should be -ad(V)^T G V,
      because the momentum G V transforms like a wrench
    unit-vector-not-reset: each column of your result is the sum of the correct column
      and all correct columns before it. For each column, only one entry of phi should
      be 1, and all others should be 0
    gravity-added: your code adds gravity to Vd. Use Vd unchanged, because it already
      includes gravity as the acceleration -g of the base
    first-moments-empty: your code returns 0 in the columns for m c. The first moment m
      c is a parameter of its own: in the unit vectors of these columns it is not 0,
      although m is 0
    """
    right = link_regressor(V, Vd)
    X = ad(V)
    G = spatial_inertia_from_params(np.eye(10))
    forces, momenta = (G @ Vd).T, (G @ V).T
    return {
        "ad-not-transposed": forces - X @ momenta,
        "ad-not-transposed-plus": forces + X @ momenta,
        "unit-vector-not-reset": np.cumsum(right, axis=1),
        "gravity-added": link_regressor(V, Vd + UP),
        "first-moments-empty": right * ~np.isin(np.arange(10), [1, 2, 3]),
    }


@row.right  # One product of tensors.
def _(V, Vd):
    G = spatial_inertia_from_params(np.eye(10))
    return np.einsum("kij,j->ik", G, Vd) - np.einsum("ji,kjl,l->ik", ad(V), G, V)


row.spans(  # as small, or as large, as in the lab
    V=(lambda V: 0.005 * V,),
    Vd=(lambda Vd: 0.2 * Vd,),
)

"""8.2 `link_regressor(V, Vd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.identification import link_regressor, spatial_inertia_from_params
from robo47.screws import ad

from .states import NUMBERS, SWAP, WRENCH

row = Row(Matrix((6, 10), rows=WRENCH, columns=NUMBERS))
REST = np.zeros(6)
UP = np.array([0, 0, 0, 0, 0, 9.81])
SPIN = np.eye(6)[2]
# A unit vector has m or m c, never both: what needs both cannot be told here.
BOTH = ["inertia-about-the-centre", "first-moment-times-m"]
row.reached_by(
    "spatial_inertia_from_params", "in spatial_inertia_from_params, ", but=BOTH
)


@row.inputs
def _(rng):
    drawn = rng.numbers(-3, 3, 8, 2, 6)
    return [(REST, UP), (SPIN, REST), *((V, Vd) for V, Vd in drawn)]


@row.wrongs
def _(V, Vd):
    """ad-not-transposed: the velocity product has -ad(V); a wrench is carried the other
      way from a twist, by the transpose => G Vd - ad(V) G V
    ad-not-transposed-plus: the velocity product has +ad(V) for -ad(V)^T => G Vd + ad(V)
      G V
    velocity-product-sign: ad(V)^T G V is added; it is taken off => G Vd + ad(V)^T G V
    velocity-product-forgotten: G Vd alone: that the momentum is carried along by V is
      missing => G Vd
    acceleration-in-the-velocity-product: the velocity product has G Vd; what is carried
      along is the momentum, G V => G Vd - ad(V)^T G Vd
    arguments-swapped: V and Vd are swapped => G V - ad(Vd)^T G Vd
    unit-vector-not-reset: the ones of the columns before are not taken away again:
      column k is the wrench of the first k numbers together => columns added up
    gravity-added: 9.81 is added to Vd; what falls is in Vd already, as a base that
      accelerates upwards => the right one with Vd + (0, 0, 0, 0, 0, 9.81)
    reshaped: (10, 6) is reshaped to (6, 10), which only counts the numbers off anew;
      columns become rows by .T => the right one with its numbers so
    first-moments-empty: the columns of m c are 0: a unit vector of m c has no mass, so
      nothing may be multiplied or divided by it => the right one without these columns
    force-first: the rows are (force; moment); the moment's three come first
    """
    X = ad(V)
    G = spatial_inertia_from_params(np.eye(10))
    forces, momenta = (G @ Vd).T, (G @ V).T
    right = link_regressor(V, Vd)
    return {
        "ad-not-transposed": forces - X @ momenta,
        "ad-not-transposed-plus": forces + X @ momenta,
        "velocity-product-sign": forces + X.T @ momenta,
        "velocity-product-forgotten": forces,
        "acceleration-in-the-velocity-product": forces - X.T @ forces,
        "arguments-swapped": link_regressor(Vd, V),
        "unit-vector-not-reset": np.cumsum(right, axis=1),
        "gravity-added": link_regressor(V, Vd + UP),
        "reshaped": right.T.reshape(6, 10),
        "first-moments-empty": right * ~np.isin(np.arange(10), [1, 2, 3]),
        "force-first": right[SWAP],
    }


@row.right  # One product of tensors.
def _(V, Vd):
    G = spatial_inertia_from_params(np.eye(10))
    return np.einsum("kij,j->ik", G, Vd) - np.einsum("ji,kjl,l->ik", ad(V), G, V)


row.spans(  # as small, or as large, as in the lab
    V=(lambda V: 0.005 * V,),
    Vd=(lambda Vd: 0.2 * Vd,),
)

"""8.2 `link_regressor(V, A)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, draw
from labkit.judge.row import Row
from robo47.identification import inertia_of, link_regressor
from robo47.screws import ad

from .states import NUMBERS, SWAP, WRENCH

row = Row(Matrix((6, 10), rows=WRENCH, columns=NUMBERS))
REST, UP, SPIN = np.zeros(6), np.array([0, 0, 0, 0, 0, 9.81]), np.eye(6)[2]
# A unit vector has m or m c, never both: what needs both cannot be told here.
HIDDEN = ["inertia-about-the-centre", "corners-empty"]
row.reached_by("inertia_of", "in inertia_of, ", but=HIDDEN)


@row.inputs
def _(rng):
    drawn = draw.numbers(rng, -3, 3, 8, 2, 6)
    return [(REST, UP), (SPIN, REST), *((V, A) for V, A in drawn)]


def costs(V, A, carried):
    """Return the columns G A + carried(ad(V), G, V), one per unit vector."""
    G = inertia_of(np.eye(10))
    return np.array([one @ A + carried(ad(V), one, V) for one in G]).T


@row.wrong
def ad_not_transposed(V, A):
    """the velocity product has -ad(V); a wrench is carried the other way from a twist,
    by the transpose => G A - ad(V) G V"""
    return costs(V, A, lambda X, G, V: -X @ G @ V)


@row.wrong
def ad_not_transposed_plus(V, A):
    """the velocity product has +ad(V) for -ad(V)^T => G A + ad(V) G V"""
    return costs(V, A, lambda X, G, V: X @ G @ V)


@row.wrong
def velocity_product_sign(V, A):
    """ad(V)^T G V is added; it is taken off => G A + ad(V)^T G V"""
    return costs(V, A, lambda X, G, V: X.T @ G @ V)


@row.wrong
def velocity_product_forgotten(V, A):
    """G A alone: that the momentum is carried along by V is missing => G A"""
    return costs(V, A, lambda X, G, V: 0 * V)


@row.wrong
def velocity_product_twice(V, A):
    """ad(V)^T G V counts twice => G A - 2 ad(V)^T G V"""
    return costs(V, A, lambda X, G, V: -2 * X.T @ G @ V)


@row.wrong
def acceleration_in_the_velocity_product(V, A):
    """the velocity product has G A; what is carried along is the momentum, G V => G A -
    ad(V)^T G A"""
    return costs(V, A, lambda X, G, V: -X.T @ G @ A)


@row.wrong
def force_first(V, A):
    """the rows are (force; moment); the moment's three come first => the right one with
    its rows swapped"""
    return link_regressor(V, A)[SWAP]


@row.wrong
def moments_empty(V, A):
    """the moment's rows are 0: only a point mass at the origin needs none => the right
    one without moments"""
    Y = link_regressor(V, A)
    Y[:3] = 0.0
    return Y


@row.wrong
def momentum_for_wrench(V, A):
    """these are momenta, G V; a wrench is their rate => G V"""
    return link_regressor(REST, V)


@row.right  # Column by column, with cross products.
def _(V, A):
    columns = []
    for unit in np.eye(10):
        G = inertia_of(unit)
        (n, f), (w, v) = np.split(G @ V, 2), np.split(V, 2)
        moved = np.append(np.cross(w, n) + np.cross(v, f), np.cross(w, f))
        columns.append(G @ A + moved)
    return np.stack(columns, axis=1)


@row.right  # One product of tensors.
def _(V, A):
    G = inertia_of(np.eye(10))
    return np.einsum("kij,j->ik", G, A) - np.einsum("ji,kjl,l->ik", ad(V), G, V)

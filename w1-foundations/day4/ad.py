"""4.5 `ad(V)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row
from robo47 import screws
from robo47.screws import adjoint, exp_screw, skew

from .states import SIX

row = Row(SIX, truth=screws.ad)
NONE = np.zeros((3, 3))


@row.inputs
def _(rng):
    case, shift = np.eye(6)[2] + np.eye(6)[3], np.array([0, 0, 0, 0.3, -0.2, 0.5])
    return [(V,) for V in (case, shift, *draw.numbers(rng, -2, 2, 9, 6))]


def blocks(V, made):
    """Return the matrix of blocks that are made of [omega] and [v]."""
    return np.block(made(skew(V[:3]), skew(V[3:])))


@row.wrong
def v_on_top(V):
    """[v] stands in the upper right; an angular velocity does not change with v, so
    that block is 0 => the matrix with [v] up there"""
    return blocks(V, lambda W, U: [[W, U], [NONE, W]])


@row.wrong
def halves_swapped(V):
    """V is read as (v; omega); omega comes first => the matrix of (v; omega)"""
    return blocks(V, lambda W, U: [[U, NONE], [W, U]])


@row.wrong
def v_forgotten(V):
    """[v] is missing: this turns both halves, and does no more => the matrix without
    [v]"""
    return np.kron(np.eye(2), skew(V[:3]))


@row.wrong
def second_omega_forgotten(V):
    """the lower right block is empty; a linear velocity is turned, too => the matrix
    with 0 there"""
    return blocks(V, lambda W, U: [[W, NONE], [U, NONE]])


@row.wrong
def v_sign(V):
    """[v] has the wrong sign: ad(V) V is not 0 => the matrix with -[v]"""
    return blocks(V, lambda W, U: [[W, NONE], [-U, W]])


@row.wrong
def v_in_both_corners(V):
    """[v] stands in both corners; the upper right one is 0 => the matrix with [v]
    twice"""
    return blocks(V, lambda W, U: [[W, U], [U, W]])


@row.wrong
def v_last(V):
    """the lower right block is [v]; both on the diagonal are [omega] => the matrix with
    [omega] and [v] on the diagonal"""
    return blocks(V, lambda W, U: [[W, NONE], [NONE, U]])


@row.wrong
def identity_added(V):
    """the identity is added; ad(V) is what changes in a second, and for V = 0 nothing
    does => the matrix plus the identity"""
    return np.eye(6) + screws.ad(V)


@row.wrong
def product_for_v(V):
    """the lower left block is [v] [omega]; a product like this, [p] R, stands in the
    adjoint of a pose. Here it is one of the two alone => the matrix with [v] [omega]
    there"""
    return blocks(V, lambda W, U: [[W, NONE], [U @ W, W]])


@row.wrong
def omega_everywhere(V):
    """[omega] stands where [v] belongs => the matrix with [omega] three times"""
    return blocks(V, lambda W, U: [[W, NONE], [W, W]])


@row.close("rounded-somewhere")  # The derivative of the adjoint, by a difference.
def _(V):
    h = 3e-4
    size = np.linalg.norm(V[:3]) or np.linalg.norm(V[3:])
    there, back = (adjoint(exp_screw(V / size, x * size)) for x in (h, -h))
    return (there - back) / (2 * h)


@row.wrong("transposed")  # What forces need, a task too early.
def _(V):
    return screws.ad(V).T


@row.wrong(
    "off", hidden="the lab's twists all turn"
)  # What does not turn is forgotten.
def _(V):
    return screws.ad(V) if V[:3].any() else np.zeros((6, 6))

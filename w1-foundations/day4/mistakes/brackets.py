"""Mistakes in task 4.5 `ad(V)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array
from robo47.screws import skew

Block = Callable[[Array, Array], Array]


def _nothing(W: Array, U: Array) -> Array:
    return 0 * W


def _omega(W: Array, U: Array) -> Array:
    return W


def _v(W: Array, U: Array) -> Array:
    return U


def _ad(
    top: Block = _omega, right: Block = _nothing, left: Block = _v, last: Block = _omega
) -> Callable[[Array], Array]:
    """Return ad of many twists, made of other blocks of [omega] and [v]."""

    def redo(V: Array) -> Array:
        W, U = skew(V[..., :3]), skew(V[..., 3:])
        out = np.empty((*W.shape[:-2], 6, 6))
        out[..., :3, :3], out[..., :3, 3:] = top(W, U), right(W, U)
        out[..., 3:, :3], out[..., 3:, 3:] = left(W, U), last(W, U)
        return out

    return redo


def _with_identity(V: Array) -> Array:
    return np.eye(6) + _ad()(V)


AD = [
    Mistake(
        "v-on-top",
        "[v] stands in the upper right; an angular velocity does not change with v, so "
        "that block is 0",
        _ad(right=_v, left=_nothing),
        "the matrix with [v] up there",
    ),
    Mistake(
        "halves-swapped",
        "V is read as (v; omega); omega comes first",
        _ad(_v, _nothing, _omega, _v),
        "the matrix of (v; omega)",
    ),
    Mistake(
        "v-forgotten",
        "[v] is missing: this turns both halves, and does no more",
        _ad(left=_nothing),
        "the matrix without [v]",
    ),
    Mistake(
        "second-omega-forgotten",
        "the lower right block is empty; a linear velocity is turned, too",
        _ad(last=_nothing),
        "the matrix with 0 there",
    ),
    Mistake(
        "v-sign",
        "[v] has the wrong sign: ad(V) V is not 0",
        _ad(left=lambda W, U: -U),
        "the matrix with -[v]",
    ),
    Mistake(
        "v-in-both-corners",
        "[v] stands in both corners; the upper right one is 0",
        _ad(right=_v),
        "the matrix with [v] twice",
    ),
    Mistake(
        "v-last",
        "the lower right block is [v]; both on the diagonal are [omega]",
        _ad(left=_nothing, last=_v),
        "the matrix with [omega] and [v] on the diagonal",
    ),
    Mistake(
        "identity-added",
        "the identity is added; ad(V) is what changes in a second, and for V = 0 "
        "nothing does",
        _with_identity,
        "the matrix plus the identity",
    ),
    Mistake(
        "product-for-v",
        "the lower left block is [v] [omega]; a product like this, [p] R, stands in "
        "the adjoint of a pose. Here it is one of the two alone",
        _ad(left=lambda W, U: U @ W),
        "the matrix with [v] [omega] there",
    ),
    Mistake(
        "omega-everywhere",
        "[omega] stands where [v] belongs",
        _ad(left=_omega),
        "the matrix with [omega] three times",
    ),
]

"""Mistakes in task 2.7: `adjoint(T)` and `body_screws(screws, M)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse, split, transposed
from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array

from .brackets import SKEW
from .moves import skew, without

Corner = Callable[[Array, Array], Array]  # from R and [p] to a 3x3 block


def _lever(R: Array, P: Array) -> Array:
    return P @ R


def _nothing(R: Array, P: Array) -> Array:
    return np.zeros_like(R)


def _blocks(
    lower: Corner = _lever,
    upper: Corner = _nothing,
    bracket: Callable[[Array], Array] = skew,
    last: Callable[[Array], Array] = np.positive,
) -> Callable[[Array], Array]:
    """Return the adjoint with other blocks."""

    def adjoint(T: Array) -> Array:
        R, p = split(T)
        out = np.zeros((*T.shape[:-2], 6, 6))
        out[..., :3, :3], out[..., 3:, 3:] = R, last(R)
        out[..., 3:, :3], out[..., :3, 3:] = lower(R, bracket(p)), upper(R, bracket(p))
        return out

    return adjoint


adjoint = _blocks()


def _turned_back(T: Array) -> Array:
    R, p = split(T)
    return _blocks()(pose(transposed(R), p))


ADJOINT = [
    Mistake(
        "of-the-inverse",
        "this is the adjoint of the inverse pose: it takes twists the other way",
        lambda T: adjoint(rigid_inverse(T)),
        "Ad of the inverse",
    ),
    Mistake(
        "block-top-right",
        "[p] R stands top right; that is for twists (v; omega), and for wrenches. Here "
        "v is the lower half, and it is v that the distance changes",
        _blocks(_nothing, _lever),
        "the right one with that block moved",
    ),
    Mistake(
        "factors-swapped",
        "the lower left block is R [p]; the lever arm is told in the outer frame, so "
        "it acts after R",
        _blocks(lambda R, P: R @ P),
        "the right one with R [p]",
    ),
    Mistake(
        "no-lever-arm",
        "the lower left block is 0: v is only turned, but a spin moves a far origin",
        _blocks(_nothing),
        "the right one without that block",
    ),
    Mistake(
        "lever-arm-not-turned",
        "the lower left block is [p] alone; omega has to be turned before",
        _blocks(lambda R, P: P),
        "the right one with [p]",
    ),
    Mistake(
        "lever-arm-sign",
        "the lower left block has the wrong sign",
        _blocks(lambda R, P: -P @ R),
        "the right one with -[p] R",
    ),
    Mistake(
        "on-both-sides",
        "[p] R stands in both corners; omega does not depend on where the origin is",
        _blocks(_lever, _lever),
        "the right one with it top right too",
    ),
    Mistake(
        "block-by-entries",
        "the lower left block is [p] * R, entry by entry; it is a product of matrices",
        _blocks(lambda R, P: P * R),
        "the right one with [p] * R",
    ),
    Mistake(
        "last-block-identity",
        "the lower right block is the identity; v has to be turned by R too",
        _blocks(last=lambda R: np.broadcast_to(np.eye(3), R.shape)),
        "the right one with I there",
    ),
    Mistake(
        "last-block-zero",
        "the blocks are R, [p] and 0: the lower right one has to be R, and the lower "
        "left one [p] R",
        _blocks(lambda R, P: P, last=np.zeros_like),
        "the right one with those blocks",
    ),
    Mistake(
        "lever-arm-turned-twice",
        "the lower left block is R [p] R; p is told in the outer frame already, so "
        "[p] R is all",
        _blocks(lambda R, P: R @ P @ R),
        "the right one with R [p] R",
    ),
    Mistake(
        "point-turned-back",
        "in [p], p is turned back by R^T; it is told in the outer frame, and [p] R is "
        "too",
        _blocks(lambda R, P: transposed(R) @ P @ R @ R),
        "the right one with [R^T p] R",
    ),
    Mistake(
        "R-turned-back",
        "R is transposed in every block: twists come out turned the other way",
        _turned_back,
        "the right one with R^T",
    ),
    Mistake(
        "transposed",
        "the matrix is transposed: that one is for wrenches",
        lambda T: transposed(adjoint(T)),
        "its transpose",
    ),
    *lifted(without(SKEW, "p-cross-w"), "in [p], ", lambda redo: _blocks(bracket=redo)),
]


def _carried(S: Array, by: Array) -> Array:
    """Return by @ S for each screw, (n, 7, 6)."""
    return S @ transposed(by)


BODY_SCREWS = [
    Mistake(
        "adjoint-of-M",
        "the adjoint is that of M; M takes hand coordinates to the world, and the "
        "screws go the other way",
        lambda S, M: _carried(S, adjoint(M)),
        "Ad(M) S",
    ),
    Mistake(
        "from-the-right",
        "the right adjoint, but rows are multiplied by it as they stand; it acts on "
        "columns",
        lambda S, M: S @ adjoint(rigid_inverse(M)),
        "S Ad(M^-1)",
    ),
    Mistake(
        "unchanged",
        "the screws come back as they went in, still seen from the world",
        lambda S, M: S + 0.0 * M[:, :1, :1],
        "the table that went in",
    ),
    Mistake(
        "last-joint-first",
        "the screws are right, but in the reverse order: joint1's comes first",
        lambda S, M: _carried(S, adjoint(rigid_inverse(M)))[:, ::-1],
        "the right answer in reverse",
    ),
    Mistake(
        "transposed-for-inverse",
        "Ad(M) is transposed, but its inverse is not its transpose (the same comes out "
        "where [p] R stands top right in the adjoint)",
        lambda S, M: S @ adjoint(M),
        "Ad(M)^T S",
    ),
    Mistake(
        "no-lever-arm",
        "both halves are only turned: in the adjoint the lower left block is 0 (was "
        "M.T taken for the inverse of M?)",
        lambda S, M: _carried(S, _blocks(_nothing)(rigid_inverse(M))),
        "the right one without that block",
    ),
    Mistake(
        "t-only-negated",
        "in the inverse of M, t is only negated: it has to be told in the hand's axes",
        lambda S, M: _carried(S, _by_parts(M)),
        "Ad S with t negated",
    ),
    *lifted(
        without(
            ADJOINT,
            *("of-the-inverse", "transposed", "block-top-right", "no-lever-arm"),
            "point-turned-back",  # here it is t only negated
        ),
        "in the adjoint, ",
        lambda redo: lambda S, M: _carried(S, redo(rigid_inverse(M))),
    ),
]


def _by_parts(M: Array) -> Array:
    R, t = split(M)
    return adjoint(pose(transposed(R), -t))

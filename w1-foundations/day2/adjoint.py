"""2.7 `adjoint(T)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Matrix, Row
from robo47 import se3
from robo47.screws import adjoint, skew

row = Row(Matrix((6, 6)))

O = np.zeros((3, 3))  # noqa: E741


@row.inputs
def _(rng):
    yield (se3.make_T(np.eye(3), [1.0, 0.0, 0.0]),)
    yield from ((T,) for T in rng.poses(8))


@row.wrongs
def _(T):
    """of-the-inverse: this is the adjoint of the inverse pose: it takes twists the
      other way => Ad of the inverse
    block-top-right: [p] R stands top right; that is for twists (v; omega), and for
      wrenches. Here v is the lower half, and it is v that the distance changes
    factors-swapped: the lower left block is R [p]; the lever arm is told in the outer
      frame, so it acts after R => the right one with R [p]
    no-lever-arm: the lower left block is 0: v is only turned, but a spin moves a far
      origin => the right one without that block
    lever-arm-not-turned: the lower left block is [p] alone; omega has to be turned
      before => the right one with [p]
    lever-arm-sign: the lower left block has the wrong sign => the right one with -[p] R
    on-both-sides: [p] R stands in both corners; omega does not depend on where the
      origin is => the right one with it top right too
    block-by-entries: the lower left block is [p] * R, entry by entry; it is a product
      of matrices => the right one with [p] * R
    last-block-identity: the lower right block is the identity; v has to be turned by R
      too => the right one with I there
    last-block-zero: the blocks are R, [p] and 0: the lower right one has to be R, and
      the lower left one [p] R => the right one with those blocks
    lever-arm-turned-twice: the lower left block is R [p] R; p is told in the outer
      frame already, so [p] R is all => the right one with R [p] R
    point-turned-back: in [p], p is turned back by R^T; it is told in the outer frame,
      and [p] R is too => the right one with [R^T p] R
    R-turned-back: R is transposed in every block: twists come out turned the other way
      => the right one with R^T
    transposed: the matrix is transposed: that one is for wrenches => its transpose
    """
    R = T[:3, :3]
    p = T[:3, 3]
    P = skew(p)
    blocks = {
        "block-top-right": [[R, P @ R], [O, R]],
        "factors-swapped": [[R, O], [R @ P, R]],
        "no-lever-arm": [[R, O], [O, R]],
        "lever-arm-not-turned": [[R, O], [P, R]],
        "lever-arm-sign": [[R, O], [-P @ R, R]],
        "on-both-sides": [[R, P @ R], [P @ R, R]],
        "block-by-entries": [[R, O], [P * R, R]],
        "last-block-identity": [[R, O], [P @ R, np.eye(3)]],
        "last-block-zero": [[R, O], [P, O]],
        "lever-arm-turned-twice": [[R, O], [R @ P @ R, R]],
        "point-turned-back": [[R, O], [skew(R.T @ p) @ R, R]],
        "R-turned-back": [[R.T, O], [P @ R.T, R.T]],
    }
    return {
        **{slug: partial(np.block, some) for slug, some in blocks.items()},
        "of-the-inverse": lambda: adjoint(se3.inverse(T)),
        "transposed": lambda: adjoint(T).T,
    }


row.reached_by("skew", "in [p], ", but=["p-cross-w"])  # the lever arm's sign

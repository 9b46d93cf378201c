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
    """block-top-right: [p] R is in the upper right block, as for wrenches and for
      twists (v; omega); in this course, omega comes first
    no-lever-arm: the lower left block is 0; v depends on omega if the origins differ =>
      the correct result without that block
    on-both-sides: [p] R is in both off-diagonal blocks; omega does not depend on the
      origin => the correct result with it top right as well
    last-block-zero: the lower blocks are [p] and 0; they should be [p] R and R => the
      correct result with those blocks
    R-turned-back: R is transposed in every block => the correct result with R^T
    transposed: the matrix is transposed; the transpose maps wrenches => its transpose
    """
    R = T[:3, :3]
    p = T[:3, 3]
    P = skew(p)
    blocks = {
        "block-top-right": [[R, P @ R], [O, R]],
        "no-lever-arm": [[R, O], [O, R]],
        "on-both-sides": [[R, P @ R], [P @ R, R]],
        "last-block-zero": [[R, O], [P, O]],
        "R-turned-back": [[R.T, O], [P @ R.T, R.T]],
    }
    return {
        **{slug: partial(np.block, some) for slug, some in blocks.items()},
        "transposed": lambda: adjoint(T).T,
    }


# Without the lever arm's sign.
row.reached_by("skew", "in [p], ", but=["p-cross-w"], called={"w_": "p_"})


@row.right  # Column by column, each lever arm a cross product.
def _(T):
    R, p = T[:3, :3], T[:3, 3]
    lever = np.cross(p, R.T).T  # the lower left block
    return np.vstack([np.hstack([R, O]), np.hstack([lever, R])])

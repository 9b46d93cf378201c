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
    """block-top-right: your code puts the block [p] R in the upper right, as for twists
      in the order (v; omega). In this course omega comes first, so the block belongs in
      the lower left
    no-lever-arm: your code sets the lower left block to 0. This block should be [p] R,
      because the transformed v also depends on omega if the two frames have different
      origins
    on-both-sides: your code puts [p] R in both off-diagonal blocks. The upper right
      block should be 0, because the transformed omega does not depend on v
    last-block-zero: your code uses [p] and 0 as the two lower blocks. The lower blocks
      should be [p] R and R
    R-turned-back: your code transposes R in every block. Use R itself
    transposed: your code returns the transpose of the adjoint, which maps wrenches
      instead of twists
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
row.reached_by(
    "skew",
    "in the skew-symmetric matrix [p], ",
    but=["p-cross-w"],
    called={"w_": "p_", " w ": " p "},
)


@row.right  # Column by column, each lever arm a cross product.
def _(T):
    R, p = T[:3, :3], T[:3, 3]
    lever = np.cross(p, R.T).T  # the lower left block
    return np.vstack([np.hstack([R, O]), np.hstack([lever, R])])

"""2.7 `body_screws(screws, M)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from robo47 import se3
from robo47.screws import adjoint, body_screws

from .arms import SCREWS, others, the_panda
from .halves import which_half

row = Row(SCREWS, unnamed=which_half)


@row.inputs
def _(rng):
    S, M, _ = the_panda()
    return [(S, M), *others(rng, 8)]


@row.wrongs
def _(screws, M):
    """adjoint-of-M: the adjoint is that of M; M takes hand coordinates to the world,
      and the screws go the other way => Ad(M) S
    from-the-right: the right adjoint, but rows are multiplied by it as they stand; it
      acts on columns => S Ad(M^-1)
    unchanged: the screws come back as they went in, still seen from the world
    last-joint-first: the screws are right, but in the reverse order: joint1's comes
      first => the right answer in reverse
    transposed-for-inverse: Ad(M) is transposed, but its inverse is not its transpose
      (the same comes out where [p] R stands top right in the adjoint) => Ad(M)^T S
    no-lever-arm: both halves are only turned: in the adjoint the lower left block is 0
      (was M.T taken for the inverse of M?) => the right one without that block
    t-only-negated: in the inverse of M, t is only negated: it has to be told in the
      hand's axes => Ad S with t negated
    """
    R = M[:3, :3]
    t = M[:3, 3]
    return {
        "adjoint-of-M": screws @ adjoint(M).T,
        "from-the-right": screws @ adjoint(se3.inverse(M)),
        "unchanged": screws.copy(),
        "last-joint-first": lambda: body_screws(screws, M)[::-1],
        "transposed-for-inverse": screws @ adjoint(M),
        "no-lever-arm": np.hstack([screws[:, :3] @ R, screws[:, 3:] @ R]),
        "t-only-negated": screws @ adjoint(se3.make_T(R.T, -t)).T,
    }


row.reached_by(
    "adjoint",
    "in the adjoint, ",
    but=[
        "of-the-inverse",
        "transposed",
        "block-top-right",
        "no-lever-arm",
        "point-turned-back",  # here it is t only negated
    ],
    hidden={"R-turned-back": "the Panda's M is symmetric"},
)

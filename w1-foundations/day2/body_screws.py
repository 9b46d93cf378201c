"""2.7 `body_screws(screws, M)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from robo47 import se3
from robo47.screws import adjoint

from .arms import SCREWS, others, the_panda
from .halves import which_half

row = Row(SCREWS, unnamed=which_half)


@row.inputs
def _(rng):
    S, M, _ = the_panda()
    return [(S, M), *others(rng, 8)]


@row.wrongs
def _(screws, M):
    """adjoint-of-M: the adjoint of M is used; M maps end-effector coordinates to the
      world, and the screws need the inverse => Ad(M) S
    from-the-right: the adjoint is correct, but it multiplies the screws as rows; the
      adjoint acts on columns => S Ad(M^-1)
    unchanged: the screws are returned unchanged, still expressed in the world frame
    transposed-for-inverse: Ad(M) is transposed, but its inverse is not its transpose.
      The same result follows if [p] R is in the upper right block of the adjoint =>
      Ad(M)^T S
    no-lever-arm: both halves are only rotated: the lower left block of the adjoint is 0
      (is M.T used as the inverse of M?) => the correct result without that block
    t-only-negated: in the inverse of M, the translation is -t; it should be expressed
      in the end-effector frame => Ad S with t negated
    """
    R = M[:3, :3]
    t = M[:3, 3]
    return {
        "adjoint-of-M": screws @ adjoint(M).T,
        "from-the-right": screws @ adjoint(se3.inverse(M)),
        "unchanged": screws.copy(),
        "transposed-for-inverse": screws @ adjoint(M),
        "no-lever-arm": np.hstack([screws[:, :3] @ R, screws[:, 3:] @ R]),
        "t-only-negated": screws @ adjoint(se3.make_T(R.T, -t)).T,
    }


row.reached_by(
    "adjoint",
    "in the adjoint, ",
    but=["transposed", "block-top-right", "no-lever-arm"],
    hidden={"R-turned-back": "the Panda's M is symmetric"},
)


@row.right  # Half by half, without an adjoint.
def _(screws, M):
    R, p = M[:3, :3], M[:3, 3]
    omega = screws[:, :3]
    v = screws[:, 3:] + np.cross(omega, p)  # velocity of the end effector's origin
    omega_body = omega @ R  # omega, expressed in the end effector's frame
    v_body = v @ R  # v, expressed in the end effector's frame
    return np.hstack([omega_body, v_body])

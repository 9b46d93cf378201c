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
    """adjoint-of-M: your code maps the screws from the end-effector frame to the world
      frame, with M instead of its inverse. Map the screws from the world frame to the
      end-effector frame
    from-the-right: your code multiplies each screw by the transpose of the correct
      adjoint Ad, as `screws @ Ad` does. Multiply each screw by Ad itself, as
      `screws @ Ad.T` does
    unchanged: your code returns the screws unchanged, so they are still expressed in
      the world frame. Express them in the end-effector frame
    transposed-for-inverse: your code multiplies each screw by the transpose of Ad(M)
      instead of its inverse. An adjoint of the inverse of M with [p] R in the upper
      right block gives the same result
    no-lever-arm: your code only rotates the two halves of each screw. The new v should
      also contain omega, because the two frames have different origins. Does your code
      use the transpose of M as the inverse of M?
    t-only-negated: your omega is correct, but your v contains a translation that is not
      rotated into the end-effector frame. If your code inverts M, rotate the negated
      translation into that frame too
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

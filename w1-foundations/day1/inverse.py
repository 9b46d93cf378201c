"""1.3 `inverse(T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from labkit.judge.matrices import pose, split

from .panda_chain import NEAR


def _scaled(rng):
    """Return poses whose R is twice a rotation: R^T and an inverse then differ."""
    T = rng.poses(2)
    T[:, :3, :3] *= 2.0
    return [(one,) for one in T]


row = Row(
    Pose(),
    near=NEAR,
    alike=[{"R-kept", "R-transposed"}, {"unchanged", "inverse-returned"}],
    held_out=[
        HeldOut(
            "general-inverse",
            "Your result is correct, but your code uses a general matrix inverse. "
            "The inverse of a rotation matrix R does not need a general method. What "
            "is special about the columns of R?",
            _scaled,
            mistaken=np.linalg.inv,
            status="close",
        )
    ],
)


@row.inputs
def _(rng):
    move = np.eye(4)
    move[0, 3] = 1.0
    return [(move,), *((T,) for T in rng.poses(5))]


@row.wrongs
def _(T):
    """unchanged: your code returns T unchanged
    T-transposed: your result is the transpose of the whole 4x4 matrix, so the
      translation is in the last row. Transpose only R, and compute the translation
      separately
    t-only-negated: your rotation is correct, but your translation is -t. The
      translation of the inverse is expressed in the rotated frame, so rotate -t into
      that frame
    t-turned-forwards: your rotation is correct, but your code rotates the translation
      by R. Rotate it by the inverse of R instead, as in -R^-1 t
    R-kept: your translation is correct, but your rotation is R instead of the inverse
      of R
    R-kept-t-negated: your rotation is R, and your translation is only -t. Use the
      inverse of R as the rotation, and multiply -t by this inverse
    R-kept-t-turned-forwards: your rotation is R, and your translation is -R t. Both
      should contain the inverse of R instead
    all-signs: your result is -T. Use the inverse of R as the rotation instead, and
      compute the translation from this inverse and t
    minus-R: your rotation is -R, and your translation is -t. The matrix -R is not a
      rotation matrix, because its determinant is -1. Use the inverse of R as the
      rotation instead, and compute the translation from this inverse and t
    """
    R, t = split(T)
    return {
        "unchanged": T.copy(),
        "T-transposed": T.T.copy(),
        "t-only-negated": pose(R.T, -t),
        "t-turned-forwards": pose(R.T, -R @ t),
        "R-kept": pose(R, -R.T @ t),
        "R-kept-t-negated": pose(R, -t),
        "R-kept-t-turned-forwards": pose(R, -R @ t),
        "all-signs": -T,
        "minus-R": pose(-R, -t),
    }


@row.wrong
def one_over_each_entry(T):
    """your code takes the reciprocal of every entry of T. Use the inverse of R as the
    rotation instead, and compute the translation from this inverse and t"""
    with np.errstate(divide="ignore"):
        return 1.0 / T


row.of_answer(of_a_pose())


@row.close("general-inverse")  # Solves T X = I.
def _(T):
    return np.linalg.solve(T, np.eye(4))

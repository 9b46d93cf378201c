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
            "Your numbers are correct, but they come from a matrix inverse. The task "
            "asks for R and t alone: what is special about the columns of R?",
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
    """unchanged: T is returned unchanged
    T-transposed: the whole 4x4 matrix is transposed, which inverts R but moves the
      translation to the last row => T transposed
    t-only-negated: the rotation is correct, but the translation is -t. The inverse's
      translation is expressed in the rotated frame, so -t has to be rotated first =>
      the correct rotation with -t
    t-turned-forwards: the rotation is correct, but -t is multiplied by R instead of the
      inverse of R
    R-kept: the translation is correct, but the rotation is still R => the correct
      translation with R
    R-kept-t-negated: the rotation is still R, and t is only negated, which inverts only
      a pure translation => R with -t
    R-kept-t-turned-forwards: R is not inverted, neither in the rotation nor in the
      translation
    all-signs: every entry is negated; the negative of a transform is not its inverse
    minus-R: R and t are only negated; -R is a reflection (det R = -1), not the inverse
      of R => the pose of -R and -t
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
    """every entry is replaced by its reciprocal; these reciprocals are not the inverse
    of the matrix => 1 over each entry"""
    with np.errstate(divide="ignore"):
        return 1.0 / T


row.of_answer(of_a_pose())


@row.close("general-inverse")  # Solves T X = I.
def _(T):
    return np.linalg.solve(T, np.eye(4))

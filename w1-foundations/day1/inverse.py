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
    alike=[
        {"R-kept", "R-transposed"},
        {"unchanged", "inverse-returned"},
        {"t-not-negated", "t-negated"},
    ],
    held_out=[
        HeldOut(
            "general-inverse",
            "The numbers are right, by way of a matrix inverse. The task asks to "
            "do without: what is special about the columns of R?",
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
    """unchanged: T comes back as it went in: nothing is undone
    T-transposed: the whole 4x4 is transposed. Only R is undone that way; the
      translation is now in the bottom row => T transposed
    t-only-negated: R is right, but t is only negated: the way back has to be told in
      the turned frame's own axes => the right one with t only negated
    t-not-negated: R is right and t is in the right axes, but it points there, not back
      => the right one with t reversed
    t-kept: R is right, but t is still the old one => the right one with t kept
    t-turned-forwards: R is right, but t is turned by R itself, not by what undoes R
    R-kept: the translation is right, but R is still the old one: the turn is not undone
      => the right one with R kept
    R-kept-t-negated: only t is negated: that undoes a plain move, but here the turn
      stays => the right one with t only negated
    R-kept-t-turned-forwards: R is not undone, neither as the new rotation nor where it
      turns t
    all-signs: every entry is negated; that undoes an addition, not a transform
    minus-R: R and t are only negated: -R is a mirror image (det R = -1), and it undoes
      nothing => the right one made of -R and -t
    """
    R, t = split(T)
    return {
        "unchanged": T.copy(),
        "T-transposed": T.T.copy(),
        "t-only-negated": pose(R.T, -t),
        "t-not-negated": pose(R.T, R.T @ t),
        "t-kept": pose(R.T, t),
        "t-turned-forwards": pose(R.T, -R @ t),
        "R-kept": pose(R, -R.T @ t),
        "R-kept-t-negated": pose(R, -t),
        "R-kept-t-turned-forwards": pose(R, -R @ t),
        "all-signs": -T,
        "minus-R": pose(-R, -t),
    }


@row.wrong
def one_over_each_entry(T):
    """each entry is inverted on its own; a matrix is undone as a whole => 1 over each
    entry"""
    with np.errstate(divide="ignore"):
        return 1.0 / T


row.of_answer(of_a_pose())


@row.close("general-inverse")  # Solves T X = I.
def _(T):
    return np.linalg.solve(T, np.eye(4))

"""1.3 `inverse(T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Pose, draw
from labkit.judge.finished import of_a_pose
from labkit.judge.matrices import pose, split
from labkit.judge.row import Row

from .panda_chain import NEAR


def _scaled(rng):
    """Return poses whose R is twice a rotation: R^T and an inverse then differ."""
    T = draw.poses(rng, 2)
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
    return [(move,), *((T,) for T in draw.poses(rng, 5))]


@row.wrong
def unchanged(T):
    """T comes back as it went in: nothing is undone"""
    return T.copy()


@row.wrong
def T_transposed(T):
    """the whole 4x4 is transposed. Only R is undone that way; the translation is now in
    the bottom row => T transposed"""
    return T.T.copy()


@row.wrong
def t_only_negated(T):
    """R is right, but t is only negated: the way back has to be told in the turned
    frame's own axes => the right one with t only negated"""
    R, t = split(T)
    return pose(R.T, -t)


@row.wrong
def t_not_negated(T):
    """R is right and t is in the right axes, but it points there, not back => the right
    one with t reversed"""
    R, t = split(T)
    return pose(R.T, R.T @ t)


@row.wrong
def t_kept(T):
    """R is right, but t is still the old one => the right one with t kept"""
    R, t = split(T)
    return pose(R.T, t)


@row.wrong
def t_turned_forwards(T):
    """R is right, but t is turned by R itself, not by what undoes R => the right one
    with t turned by R"""
    R, t = split(T)
    return pose(R.T, -R @ t)


@row.wrong
def R_kept(T):
    """the translation is right, but R is still the old one: the turn is not undone =>
    the right one with R kept"""
    R, t = split(T)
    return pose(R, -R.T @ t)


@row.wrong
def R_kept_t_negated(T):
    """only t is negated: that undoes a plain move, but here the turn stays => the right
    one with t only negated"""
    R, t = split(T)
    return pose(R, -t)


@row.wrong
def R_kept_t_turned_forwards(T):
    """R is not undone, neither as the new rotation nor where it turns t"""
    R, t = split(T)
    return pose(R, -R @ t)


@row.wrong
def all_signs(T):
    """every entry is negated; that undoes an addition, not a transform => its
    negative"""
    return -T


@row.wrong
def minus_R(T):
    """R and t are only negated: -R is a mirror image (det R = -1), and it undoes
    nothing => the right one made of -R and -t"""
    R, t = split(T)
    return pose(-R, -t)


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

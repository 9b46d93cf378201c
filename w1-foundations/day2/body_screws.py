"""2.7 `body_screws(screws, M)`: its questions and its mistakes."""

import numpy as np

from labkit.judge.row import Row
from robo47 import se3
from robo47.screws import adjoint, body_screws

from .arms import SCREWS, others, the_panda
from .halves import which_half

row = Row(SCREWS, unnamed=which_half)


@row.inputs
def _(rng):
    S, M, _ = the_panda()
    return [(S, M), *others(rng, 8)]


@row.wrong
def adjoint_of_M(screws, M):
    """the adjoint is that of M; M takes hand coordinates to the world, and the screws
    go the other way => Ad(M) S"""
    return screws @ adjoint(M).T


@row.wrong
def from_the_right(screws, M):
    """the right adjoint, but rows are multiplied by it as they stand; it acts on
    columns => S Ad(M^-1)"""
    return screws @ adjoint(se3.inverse(M))


@row.wrong
def unchanged(screws, M):
    """the screws come back as they went in, still seen from the world => the table that
    went in"""
    return screws.copy()


@row.wrong
def last_joint_first(screws, M):
    """the screws are right, but in the reverse order: joint1's comes first => the right
    answer in reverse"""
    return body_screws(screws, M)[::-1]


@row.wrong
def transposed_for_inverse(screws, M):
    """Ad(M) is transposed, but its inverse is not its transpose (the same comes out
    where [p] R stands top right in the adjoint) => Ad(M)^T S"""
    return screws @ adjoint(M)


@row.wrong
def no_lever_arm(screws, M):
    """both halves are only turned: in the adjoint the lower left block is 0 (was M.T
    taken for the inverse of M?) => the right one without that block"""
    R = M[:3, :3]
    return np.hstack([screws[:, :3] @ R, screws[:, 3:] @ R])


@row.wrong
def t_only_negated(screws, M):
    """in the inverse of M, t is only negated: it has to be told in the hand's axes =>
    Ad S with t negated"""
    return screws @ adjoint(se3.make_T(M[:3, :3].T, -M[:3, 3])).T


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

"""8.4 `motor_features(qd, qdd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, draw
from labkit.judge.row import Row

row = Row(Matrix((7, 21)))
FIRST = np.eye(7)[0]


@row.inputs
def _(rng):
    # The middle of a range is asked, too, and 0 is where a sign jumps.
    qd, qdd = draw.numbers(rng, -2, 3, 6, 7), draw.numbers(rng, -9, 9, 6, 7)
    qd[0, 2], qd[1, 5] = 0.0, 0.01  # a joint at rest; one that hardly moves
    return [(0.5 * FIRST, 2.0 * FIRST), *zip(qd, qdd, strict=True)]


def side_by_side(*blocks):
    """Return diagonal blocks side by side."""
    return np.hstack([np.diag(block) for block in blocks])


@row.wrong
def sign_of_the_acceleration(qd, qdd):
    """dry friction takes the sign of qdd; it works against the motion, so that of qd
    => sign(qdd) in the last block"""
    return side_by_side(qdd, qd, np.sign(qdd))


@row.wrong
def smoothed(qd, qdd):
    """dry friction is tanh(qd / 0.1); here it is the sign itself; the lab leaves slow
    rows out => tanh(qd / 0.1) in the last block"""
    return side_by_side(qdd, qd, np.tanh(qd / 0.1))


@row.wrong
def sign_at_rest(qd, qdd):
    """a joint at rest is given a direction; sign(0) is 0 => 1 where qd is 0"""
    return side_by_side(qdd, qd, np.where(qd < 0.0, -1.0, 1.0))


@row.wrong
def dry_forgotten(qd, qdd):
    """dry friction is missing: its seven columns are 0 => the last block empty"""
    return side_by_side(qdd, qd, 0 * qd)


@row.wrong
def viscous_forgotten(qd, qdd):
    """viscous friction is missing: its seven columns are 0 => the middle block empty"""
    return side_by_side(qdd, 0 * qd, np.sign(qd))


@row.wrong
def rotors_forgotten(qd, qdd):
    """the rotors are missing: their seven columns are 0 => the first block empty"""
    return side_by_side(0 * qdd, qd, np.sign(qd))


@row.wrong
def friction_drives(qd, qdd):
    """friction has a minus; the motors give this torque against it => both blocks of
    friction negative"""
    return side_by_side(qdd, -qd, -np.sign(qd))


@row.wrong
def velocity_first(qd, qdd):
    """the blocks are in another order: rotors (qdd), viscous (qd), dry (its sign) => qd
    first, then qdd"""
    return side_by_side(qd, qdd, np.sign(qd))


@row.wrong
def dry_without_sign(qd, qdd):
    """dry friction has no direction: its entries are 1 whichever way a joint turns => 1
    on the last diagonal"""
    return side_by_side(qdd, qd, np.ones(7))


@row.wrong
def by_joint(qd, qdd):
    """three columns per joint; all rotors come first, then all viscous, then all dry =>
    the right one with its columns by joint"""
    Y = side_by_side(qdd, qd, np.sign(qd)).reshape(7, 3, 7)
    return np.swapaxes(Y, 1, 2).reshape(7, 21)


@row.right  # Joint by joint, without sign().
def _(qd, qdd):
    Y = np.zeros((7, 21))
    for i in range(7):
        Y[i, i], Y[i, 7 + i] = qdd[i], qd[i]
        Y[i, 14 + i] = float(qd[i] > 0) - float(qd[i] < 0)
    return Y

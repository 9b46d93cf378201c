"""8.4 `motor_features(qd, qdd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((7, 21)), at_edge=lambda qd, qdd: bool(qd.all()))  # 0: a sign jumps
FIRST = np.eye(7)[0]


@row.inputs
def _(rng):
    # The middle of a range is asked, too, and 0 is where a sign jumps.
    qd, qdd = rng.numbers(-2, 3, 6, 7), rng.numbers(-9, 9, 6, 7)
    qd[[0, 1, 2], [2, 5, 3]] = 0.0, 0.01, 1e-4  # a joint at rest; two that hardly move
    return [(0.5 * FIRST, 2.0 * FIRST), *zip(qd, qdd, strict=True)]


def side_by_side(*blocks):
    """Return diagonal blocks side by side."""
    return np.hstack([np.diag(block) for block in blocks])


for slug, says, redone, blocks in (
    ("sign-of-the-acceleration", "dry friction takes the sign of qdd; it works against "
     "the motion: that of qd", "sign(qdd) in the last block",
     lambda qd, qdd: (qdd, qd, np.sign(qdd))),
    ("smoothed", "dry friction is tanh(qd / 0.1); here it is the sign itself, and slow "
     "rows are left out", "tanh(qd / 0.1) in the last block",
     lambda qd, qdd: (qdd, qd, np.tanh(qd / 0.1))),
    ("sign-at-rest", "a joint at rest is given a direction; sign(0) is 0",
     "1 where qd is 0", lambda qd, qdd: (qdd, qd, np.where(qd < 0.0, -1.0, 1.0))),
    ("sign-at-rest-negative", "a joint at rest is given a direction, backwards; "
     "sign(0) is 0", "-1 where qd is 0",
     lambda qd, qdd: (qdd, qd, np.where(qd > 0.0, 1.0, -1.0))),
    ("dry-forgotten", "dry friction is missing: its seven columns are 0",
     "the last block empty", lambda qd, qdd: (qdd, qd, 0 * qd)),
    ("friction-drives", "friction has a minus; the motors give this torque against it",
     "both blocks of friction negative", lambda qd, qdd: (qdd, -qd, -np.sign(qd))),
    ("velocity-first", "the blocks are in another order: rotors (qdd), viscous (qd), "
     "dry (its sign)", "qd first, then qdd", lambda qd, qdd: (qd, qdd, np.sign(qd))),
):  # fmt: skip
    row.wrong(slug, says, redone)(
        lambda qd, qdd, blocks=blocks: side_by_side(*blocks(qd, qdd))
    )


@row.wrong
def by_joint(qd, qdd):
    """three columns per joint; all rotors come first, then all viscous, then all dry =>
    the right one with its columns by joint"""
    Y = side_by_side(qdd, qd, np.sign(qd)).reshape(7, 3, 7)
    return np.swapaxes(Y, 1, 2).reshape(7, 21)

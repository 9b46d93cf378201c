"""8.4 `actuator_regressor(qd, qdd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding


def slow(case: Case) -> Finding | None:
    """Say that dry friction grows with the speed, where that is all that is wrong."""
    trios = [(case.arguments[0], case.S, case.T)]
    if case.further:
        more = case.further
        trios.append((more.arguments[0], more.S[0], more.T[0]))
    for qd, S, T in trios:
        if np.abs(S - T)[..., :14].max() > 1e-6:
            return None
        size = np.abs(S[..., 14:])
        same_sign = (S * T)[..., 14:] >= 0
        if not (same_sign & (size <= np.abs(T[..., 14:]))).all():
            return None
        own = np.diagonal(size, axis1=1, axis2=2).ravel()  # of each joint its own
        if (np.diff(own[np.argsort(np.abs(qd).ravel())]) < -1e-9).any():
            return None  # a faster one has less
    says = "A joint that moves slowly gets less dry friction than a fast one, or none. "
    says += "It has one size, whatever the speed: the sign says which way it works."
    return Finding("slow-left-out", says)


BLOCKS = ("the rotors", "viscous friction", "dry friction")
row = Row(
    Matrix((7, 21), blocks=BLOCKS),
    at_edge=lambda qd, qdd: bool(qd.all()),  # 0: a sign jumps
    unnamed=slow,
)
FIRST = np.eye(7)[0]


@row.inputs
def _(rng):
    # The middle of a range is asked, too, and 0 is where a sign jumps.
    qd, qdd = rng.numbers(-2, 3, 6, 7), rng.numbers(-9, 9, 6, 7)
    qd[[0, 1, 2], [2, 5, 3]] = 0.0, 0.01, 1e-4  # a joint at rest; two that hardly move
    qd[[3, 4, 5], [0, 4, 6]] = 0.0
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
    ("sign-at-rest-of-qdd", "a joint at rest is given the direction of its "
     "acceleration; sign(0) is 0", "sign(qdd) where qd is 0",
     lambda qd, qdd: (qdd, qd, np.where(qd == 0.0, np.sign(qdd), np.sign(qd)))),
    ("slow-left-out", "a joint that moves slowly gets no dry friction; it has one "
     "size, whatever the speed", "0 where |qd| is under 0.1",
     lambda qd, qdd: (qdd, qd, np.sign(qd) * (np.abs(qd) >= 0.1))),
    ("dry-one-way", "dry friction works one way only: it is 0 where qd is negative, "
     "and has to be -1 there", "1 where qd is positive, and else 0",
     lambda qd, qdd: (qdd, qd, np.maximum(np.sign(qd), 0.0))),
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


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 0.009 * qd,),
    qdd=(lambda qdd: 0.003 * qdd,),
)

"""8.4 `actuator_regressor(qd, qdd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding


def slow(case: Case) -> Finding | None:
    """Return that only dry friction is wrong, because it grows with the velocity."""
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
        own = np.diagonal(size, axis1=1, axis2=2).ravel()  # each joint's own entry
        if (np.diff(own[np.argsort(np.abs(qd).ravel())]) < -1e-9).any():
            return None  # it does not grow with the velocity
    says = "In your result, the magnitude of dry friction is below 1 for some moving "
    says += "joints. It should be 1, because the velocity determines only the sign."
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
    # The middle of each range is tested too, and 0, where the sign jumps.
    qd, qdd = rng.numbers(-2, 3, 6, 7), rng.numbers(-9, 9, 6, 7)
    qd[[0, 1, 2], [2, 5, 3]] = 0.0, 0.01, 1e-4  # a joint at rest and two slow ones
    qd[[3, 4, 5], [0, 4, 6]] = 0.0
    return [(0.5 * FIRST, 2.0 * FIRST), *zip(qd, qdd, strict=True)]


def side_by_side(*blocks):
    """Return diagonal blocks side by side."""
    return np.hstack([np.diag(block) for block in blocks])


for slug, says, blocks in (
    ("smoothed",
     "your dry friction is the smooth function tanh(qd / 0.1). Use the sign of qd "
     "instead",
     lambda qd, qdd: (qdd, qd, np.tanh(qd / 0.1))),
    ("sign-at-rest",
     "your code returns 1 for the dry friction of a joint at rest. Return 0 instead, "
     "because the sign of 0 is 0",
     lambda qd, qdd: (qdd, qd, np.where(qd < 0.0, -1.0, 1.0))),
    ("sign-at-rest-negative",
     "your code returns -1 for the dry friction of a joint at rest. Return 0 instead, "
     "because the sign of 0 is 0",
     lambda qd, qdd: (qdd, qd, np.where(qd > 0.0, 1.0, -1.0))),
    ("sign-at-rest-of-qdd",
     "your code uses the sign of qdd for the dry friction of a joint at rest. Use the "
     "sign of qd instead, because it is 0 at rest",
     lambda qd, qdd: (qdd, qd, np.where(qd == 0.0, np.sign(qdd), np.sign(qd)))),
    ("slow-left-out",
     "your code returns 0 for the dry friction of a slow joint. Use the sign of qd "
     "instead, because the magnitude of dry friction does not depend on the velocity",
     lambda qd, qdd: (qdd, qd, np.sign(qd) * (np.abs(qd) >= 0.1))),
    ("dry-one-way",
     "your code returns 0 for the dry friction of a joint with a negative qd. Return "
     "-1 instead, because dry friction has the sign of qd",
     lambda qd, qdd: (qdd, qd, np.maximum(np.sign(qd), 0.0))),
    ("dry-forgotten",
     "your code returns 0 in the seven columns of dry friction. Write the signs of qd "
     "on the diagonal of this 7x7 block",
     lambda qd, qdd: (qdd, qd, 0 * qd)),
):  # fmt: skip
    row.wrong(slug, says)(lambda qd, qdd, blocks=blocks: side_by_side(*blocks(qd, qdd)))


@row.wrong
def by_joint(qd, qdd):
    """your code groups the columns by joint. Put the seven rotor columns first, then
    the seven columns of viscous friction, then the seven columns of dry friction"""
    Y = side_by_side(qdd, qd, np.sign(qd)).reshape(7, 3, 7)
    return np.swapaxes(Y, 1, 2).reshape(7, 21)


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 0.009 * qd,),
    qdd=(lambda qdd: 0.003 * qdd,),
)

"""3.8 `nullspace_projection(J, dq)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Case, Finding, Row, Slip, Vector
from labkit.judge.answers import difference
from labkit.judge.kinds import one_factor
from labkit.judge.matrices import times
from robo47.jacobian import dls_step

from .jacobians import JOINTS, UNIT, site_jacobians

pinv = np.linalg.pinv


def what_the_hand_feels(case: Case) -> Finding | None:
    """Return whether the hand feels the answer, and if not, what is wrong with it."""
    J = case.arguments[0]
    S = case.S
    T = case.T
    if one_factor(case.ask.kinds[0], S, T):
        return None  # which says more
    felt = np.abs(times(J, S)).max(axis=1)
    if felt.max() > 1e-5:
        k = int((felt > 1e-5).sum())
        return Finding(
            "felt",
            f"The hand feels it, for {k} of {len(S)} inputs: J times your answer has "
            f"entries of up to {felt.max():.2g}, and should be 0.",
        )
    i = int(np.argmax(difference(S, T)))
    return Finding(
        "not-felt-but-off",
        "The hand does not feel it (J times your answer is 0), but it is not the part "
        f"of dq: its length is {np.linalg.norm(S[i]):.3g}, not "
        f"{np.linalg.norm(T[i]):.3g}.",
    )


NO_INVERSE = Slip(
    "LinAlgError: Singular",
    "",
    "no-inverse",
    "J may be singular, and J J^T has no inverse then: J^+ is numpy.linalg.pinv(J) "
    "there, too.",
)
row = Row(
    Vector((7,), "rad", names=JOINTS), unnamed=what_the_hand_feels, slips=[NO_INVERSE]
)


@row.inputs
def _(rng):
    J = site_jacobians(rng.configurations(9))
    J[0, 0] = 0.0  # rank 5: two motions are not felt
    return [(UNIT, np.ones(7)), *zip(J, rng.numbers(-1, 1, 9, 7), strict=True)]


@row.wrongs(hidden={"one-direction-only": "its J have rank 6"})
def _(J, dq):
    """transpose-for-pseudo-inverse: J^T stands where J^+ belongs: I - J^T J is no
      projector, and the hand feels it => dq - J^T J dq
    felt-part: this is the part that the hand does feel, J^+ J dq; the rest is asked for
    unchanged: dq comes back as it was => dq itself
    added: the part that the hand feels is added; it has to be taken away => dq + J^+ J
      dq
    nothing-left: nothing is left: seven joints always have a motion that the hand does
      not feel => zeros
    normalised: its length is made 1; the part of dq that the hand does not feel has a
      length of its own => the right one over its length
    one-direction-only: only the last right singular vector is kept. Where J is
      singular, there are more motions that the hand does not feel => dq along that
      vector
    position-only: only the three v rows of J are used: the hand stays where it is, but
      it turns => the projector of three rows
    """
    felt = pinv(J) @ (J @ dq)
    left = dq - felt
    last = np.linalg.svd(J)[2][-1]
    return {
        "transpose-for-pseudo-inverse": dq - J.T @ (J @ dq),
        "felt-part": felt,
        "unchanged": dq,
        "added": dq + felt,
        "nothing-left": np.zeros(7),
        "normalised": left / np.linalg.norm(left),
        "one-direction-only": (last @ dq) * last,
        "position-only": dq - pinv(J[3:]) @ (J[3:] @ dq),
    }


for damping in (0.05, 0.1, 0.01):
    row.wrong(
        "damped-projector",
        f"the pseudo-inverse in it is damped (by {damping}), so a part of the felt "
        "motion stays",
        "the projector with damping",
    )(lambda J, dq, damping=damping: dq - dls_step(J, J @ dq, damping))


@row.wrong("felt")  # Joint 7 alone moves, as in the docstring.
def _(J, dq):
    return np.append(np.zeros(6), dq[6])


@row.wrong("not-felt-but-off")  # The last right singular vector, whatever dq is.
def _(J, dq):
    return np.linalg.svd(J)[2][-1]


@row.right  # Along the right singular vectors whose value is 0.
def _(J, dq):
    _, values, Vt = np.linalg.svd(J)
    N = Vt[np.sum(values > 1e-12 * values[0]) :]
    return N.T @ (N @ dq)

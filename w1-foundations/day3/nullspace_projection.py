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
    """Return whether the answer moves the hand, and if not, what is wrong with it."""
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
            f"The hand moves in {k} of {len(S)} calls. J times your result should be "
            f"0, but it has entries of up to {felt.max():.2g} in absolute value.",
        )
    i = int(np.argmax(difference(S, T)))
    return Finding(
        "not-felt-but-off",
        f"J times your result is 0, so the hand does not move, but your result is not "
        f"the projection of dq. The norm of your result is {np.linalg.norm(S[i]):.3g}; "
        f"expected {np.linalg.norm(T[i]):.3g}.",
    )


NO_INVERSE = Slip(
    "LinAlgError: Singular",
    "",
    "no-inverse",
    "If J is singular, J J^T has no inverse. Use numpy.linalg.pinv(J) for J^+.",
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
    """transpose-for-pseudo-inverse: your code uses J^T instead of J^+, so the hand
      moves for most J
    felt-part: your code returns J^+ J dq, which is the part of dq that moves the hand.
      Return the remaining part of dq
    unchanged: your code returns dq unchanged. Subtract the part of dq that moves the
      hand
    added: your code adds the part of dq that moves the hand. Subtract this part instead
    nothing-left: your result is 0 in every call. An arm with seven joints always has
      motions that do not move the hand. Return the part of dq along these motions
    normalised: your code normalises the result. Return the projection itself, whose
      norm depends on dq
    one-direction-only: for a singular J of shape (6, 7), your result contains only one
      of the directions that J maps to 0. Use all of these directions, because a
      singular J has more than one
    first-direction-kept: your code does not remove the part of dq along the first right
      singular vector. Remove this part too, because this direction moves the hand most
    position-only: your code uses only the three rows of v in J, so the hand rotates.
      Use all six rows
    """
    felt = pinv(J) @ (J @ dq)
    left = dq - felt
    directions = np.linalg.svd(J)[2]
    first, last = directions[0], directions[-1]
    return {
        "transpose-for-pseudo-inverse": dq - J.T @ (J @ dq),
        "felt-part": felt,
        "unchanged": dq,
        "added": dq + felt,
        "nothing-left": np.zeros(7),
        "normalised": left / np.linalg.norm(left),
        "one-direction-only": (last @ dq) * last,
        "first-direction-kept": left + (first @ dq) * first,
        "position-only": dq - pinv(J[3:]) @ (J[3:] @ dq),
    }


@row.wrong
def damped_projector(J, dq):
    """your code uses a pseudo-inverse with a damping of 0.05, so the hand still moves.
    Use the pseudo-inverse without damping instead"""
    return dq - dls_step(J, J @ dq, 0.05)


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

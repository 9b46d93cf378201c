"""6.1 `task_inertia(J_site, M)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Symmetric
from labkit.judge.argument_mistakes import HALVES_SWAPPED
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.checks import Array

from .states import J_CASE, M_CASE, model, states


def damped(case: Case) -> Finding | None:
    """Return what was added to the diagonal of J M^-1 J^T before the inversion."""
    extra = np.linalg.inv(case.S) - np.linalg.inv(case.T)
    added = np.median(extra[:, range(6), range(6)])
    if added > 1e-8 and np.abs(extra - added * np.eye(6)).max() < 0.01 * added:
        return Finding("damped", f"{DAMPED} The added number is {added:.2g}.")
    return None


DAMPED = (
    "In your result, a number is added to the diagonal of J M^-1 J^T before the "
    "inversion. Omit this number, because it makes Lambda too small."
)
NEARLY_SINGULAR = HeldOut(
    "small-values-cut",
    "Your result is correct except near a singularity. In the direction in which the "
    "hand hardly moves, its inertia is large, not 0. Does your code use a "
    "pseudo-inverse that discards small singular values?",
    lambda rng: [(np.diag([1.0, 1.0, 1.0, 1.0, 1.0, 0.01]) @ J_CASE, 2.0 * M_CASE)],
    mistaken=lambda J, M: np.linalg.pinv(J @ np.linalg.solve(M, J.T), 1e-3),
)
row = Row(Symmetric((6, 6)), unnamed=damped, held_out=[NEARLY_SINGULAR])
row.of_argument("J_site", HALVES_SWAPPED.called("rows-swapped"))


@row.inputs
def _(rng):
    drawn = [model(now)[:2] for now in states(rng)]
    return [(J_CASE, 2.0 * M_CASE), *drawn]


ARMATURE = 0.1


def inertia(J: Array, M: Array) -> Array:
    """Return Lambda, right."""
    return np.linalg.inv(J @ np.linalg.solve(M, J.T))


@row.wrongs
def _(J, M):
    """inverse-forgotten: your code returns the inverse of Lambda, which maps a wrench
      to an acceleration. Lambda should map an acceleration to a wrench
    M-not-inverted: your result is J M J^T. Lambda should be the inverse of J M^-1 J^T,
      because M^-1 maps the joint torques J^T F to joint accelerations
    pinv-both-sides: your code returns pinv(J)^T M pinv(J). This is correct if J is
      square, but in general not for seven joints. Invert J M^-1 J^T instead, because
      the seventh joint also allows internal motions, which reduce the inertia at the
      hand
    armature-left-out: your result omits the armature (the rotor inertia of the motors).
      Use M unchanged, because the rotors contribute to the inertia at the hand
    armature-twice: your result contains the armature twice. Use M unchanged, because M
      already contains the armature
    diagonal-inverted: your result is the inverse of only the diagonal of J M^-1 J^T.
      The six directions are coupled, so invert the whole matrix
    entries-inverted: each entry of your result is the reciprocal of the entry of J M^-1
      J^T. Use the matrix inverse instead
    blocks-alone: your result contains the separate inverses of the two 3x3 diagonal
      blocks of J M^-1 J^T. A force also rotates the hand, so invert the whole 6x6
      matrix
    """
    A = J @ np.linalg.solve(M, J.T)
    back = np.linalg.pinv(J)
    block = np.kron(np.eye(2), np.ones((3, 3)))
    return {
        "inverse-forgotten": A,
        "M-not-inverted": J @ M @ J.T,
        "pinv-both-sides": back.T @ M @ back,
        "armature-left-out": inertia(J, M - ARMATURE * np.eye(7)),
        "armature-twice": inertia(J, M + ARMATURE * np.eye(7)),
        "diagonal-inverted": np.diag(1.0 / np.diag(A)),
        "entries-inverted": 1.0 / A,
        "blocks-alone": np.linalg.inv(A * block),
    }


@row.right  # By a Cholesky factor of M.
def _(J, M):
    L = np.linalg.cholesky(M)
    A = np.linalg.solve(L, J.T)
    return np.linalg.inv(A.T @ A)


@row.right  # By the singular values of J M^-1/2.
def _(J, M):
    values, V = np.linalg.eigh(M)
    half = V / np.sqrt(values) @ V.T
    U, s, _ = np.linalg.svd(J @ half, full_matrices=False)
    return U / s**2 @ U.T


@row.close("rounded-somewhere")  # float32 inside.
def _(J, M):
    A = (J @ np.linalg.solve(M, J.T)).astype(np.float32)
    return np.linalg.inv(A.astype(np.float64))


@row.close("rounded-somewhere")  # A little is added against singularities.
def _(J, M):
    A = J @ np.linalg.solve(M, J.T)
    return np.linalg.inv(A + 1e-9 * np.eye(6))

"""6.1 `task_inertia(J_site, M)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Symmetric
from labkit.judge.argument_mistakes import HALVES_SWAPPED
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.checks import Array

from .states import J_CASE, M_CASE, model, states


def damped(case: Case) -> Finding | None:
    """Say how much was added to the diagonal of J M^-1 J^T before it was inverted."""
    extra = np.linalg.inv(case.S) - np.linalg.inv(case.T)
    added = np.median(extra[:, range(6), range(6)])
    if added > 1e-8 and np.abs(extra - added * np.eye(6)).max() < 0.01 * added:
        return Finding("damped", f"{DAMPED} Here it is {added:.2g}.")
    return None


DAMPED = (
    "Something is added to the diagonal of J M^-1 J^T before it is inverted. That "
    "keeps Lambda finite at a singularity and makes it too small everywhere else."
)
NEARLY_SINGULAR = HeldOut(
    "small-values-cut",
    "Right, but not near a singularity: in the direction in which the hand hardly "
    "moves it is heaviest, not weightless. Does a pseudo-inverse cut small values off?",
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
    """inverse-forgotten: this is the inverse of Lambda: it says how far a push
      accelerates the hand, not how heavy the hand is => J M^-1 J^T
    M-not-inverted: M stands between J and J^T as it is; a push meets the joints'
      torques first, and torques make accelerations through M^-1 => J M J^T
    pinv-both-sides: pinv(J)^T M pinv(J) is right for an arm of six joints; with seven
      the elbow is free to give way, and the hand is lighter => pinv(J)^T M pinv(J)
    M-left-out: M is not in it: (J J^T)^-1 knows where the joints are, not what they
      carry => (J J^T)^-1
    armature-left-out: the armature is taken out of M; the rotors turn with the joints,
      so somebody who pushes the hand feels them => Lambda of M - 0.1 I
    armature-twice: the armature is added to M; M has it already => Lambda of M + 0.1 I
    diagonal-of-M: only the diagonal of M is used; the joints pull at each other =>
      Lambda of M's diagonal
    diagonal-inverted: only the diagonal of J M^-1 J^T is inverted; the six directions
      are coupled => that diagonal
    entries-inverted: 1 / A inverts every entry; the inverse of a matrix is another
      thing => 1 / (J M^-1 J^T)
    blocks-alone: the two 3x3 blocks are inverted alone; a push turns the hand, too, so
      the directions are coupled => the inverse of each block
    """
    A = J @ np.linalg.solve(M, J.T)
    back = np.linalg.pinv(J)
    block = np.kron(np.eye(2), np.ones((3, 3)))
    return {
        "inverse-forgotten": A,
        "M-not-inverted": J @ M @ J.T,
        "pinv-both-sides": back.T @ M @ back,
        "M-left-out": np.linalg.inv(J @ J.T),
        "armature-left-out": inertia(J, M - ARMATURE * np.eye(7)),
        "armature-twice": inertia(J, M + ARMATURE * np.eye(7)),
        "diagonal-of-M": inertia(J, np.diag(np.diag(M))),
        "diagonal-inverted": np.diag(1.0 / np.diag(A)),
        "entries-inverted": 1.0 / A,
        "blocks-alone": np.linalg.inv(A * block),
    }


@row.wrong
def M_not_inverted(J, M):
    """M stands between J and J^T as it is, and the product is inverted; M has to be
    inverted too => (J M J^T)^-1"""
    return np.linalg.inv(J @ M @ J.T)


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

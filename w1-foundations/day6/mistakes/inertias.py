"""Mistakes in task 6.1 `task_inertia(J, M)`."""

import numpy as np

from robo47.checks import Array

from . import named

ARMATURE = 0.1  # kg m2, of every joint of the Panda


def inertia(J: Array, M: Array) -> Array:
    """Return Lambda, right."""
    return np.linalg.inv(J @ np.linalg.solve(M, J.T))


SWAP = [3, 4, 5, 0, 1, 2]
TASK_INERTIA = [
    named(
        "inverse-forgotten",
        "this is the inverse of Lambda: it says how far a push accelerates the hand, "
        "not how heavy the hand is",
        lambda J, M: J @ np.linalg.solve(M, J.T),
        "J M^-1 J^T",
    ),
    named(
        "M-not-inverted",
        "M stands between J and J^T as it is; a push meets the joints' torques first, "
        "and torques make accelerations through M^-1",
        lambda J, M: J @ M @ J.T,
        "J M J^T",
    ),
    named(
        "M-not-inverted",
        "M stands between J and J^T as it is, and the product is inverted; M has to be "
        "inverted too",
        lambda J, M: np.linalg.inv(J @ M @ J.T),
        "(J M J^T)^-1",
    ),
    named(
        "pinv-both-sides",
        "pinv(J)^T M pinv(J) is right for an arm of six joints; with seven the elbow "
        "is free to give way, and the hand is lighter",
        lambda J, M: np.linalg.pinv(J).T @ M @ np.linalg.pinv(J),
        "pinv(J)^T M pinv(J)",
    ),
    named(
        "M-left-out",
        "M is not in it: (J J^T)^-1 knows where the joints are, not what they carry",
        lambda J, M: np.linalg.inv(J @ J.T),
        "(J J^T)^-1",
    ),
    named(
        "armature-left-out",
        "the armature is taken out of M; the rotors turn with the joints, so somebody "
        "who pushes the hand feels them",
        lambda J, M: inertia(J, M - ARMATURE * np.eye(7)),
        "Lambda of M - 0.1 I",
    ),
    named(
        "armature-twice",
        "the armature is added to M; M has it already",
        lambda J, M: inertia(J, M + ARMATURE * np.eye(7)),
        "Lambda of M + 0.1 I",
    ),
    named(
        "rows-swapped",
        "the rows of J are put in the order (v; omega); here the angular three come "
        "first, in J as in every wrench",
        lambda J, M: inertia(J[SWAP], M),
        "Lambda of J with its halves swapped",
    ),
    named(
        "diagonal-of-M",
        "only the diagonal of M is used; the joints pull at each other",
        lambda J, M: inertia(J, np.diag(np.diag(M))),
        "Lambda of M's diagonal",
    ),
    named(
        "diagonal-inverted",
        "only the diagonal of J M^-1 J^T is inverted; the six directions are coupled",
        lambda J, M: np.diag(1.0 / np.diag(J @ np.linalg.solve(M, J.T))),
        "that diagonal",
    ),
    named(
        "entries-inverted",
        "1 / A inverts every entry; the inverse of a matrix is another thing",
        lambda J, M: 1.0 / (J @ np.linalg.solve(M, J.T)),
        "1 / (J M^-1 J^T)",
    ),
]

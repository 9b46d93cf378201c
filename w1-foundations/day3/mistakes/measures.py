"""Mistakes in tasks 3.7 and 3.8: `manipulability(J)` and `null_step(J, dq)`.

`redo` takes J (n, 6, 7), and dq (n, 7).
"""

import numpy as np

from labkit.judge import Case, Finding
from labkit.judge.compare import difference
from labkit.judge.kinds import one_factor
from labkit.judge.matrices import times, transposed
from labkit.judge.mistake import Mistake, each
from robo47.checks import Array

from .steps import damped


def _determinant(J: Array) -> Array:
    return np.linalg.det(J @ transposed(J))


def _values(J: Array) -> Array:
    return np.linalg.svd(J, compute_uv=False)


@each
def _plain_root(J: Array) -> Array:
    return np.sqrt(np.linalg.det(J @ J.T))


@each
def _root_of_eigenvalues(J: Array) -> Array:
    return np.sqrt(np.prod(np.linalg.eigvalsh(J @ J.T)))


MANIPULABILITY = [
    Mistake(
        "no-square-root",
        "the square root is missing: this is det(J J^T)",
        _determinant,
        "det(J J^T)",
    ),
    Mistake(
        "other-product",
        "J^T J is 7x7 and always singular; J J^T is the one that is meant",
        lambda J: np.sqrt(np.abs(np.linalg.det(transposed(J) @ J))),
        "the root of det(J^T J)",
    ),
    Mistake(
        "smallest-singular-value",
        "this is the smallest singular value alone; the product of all six is asked "
        "for",
        lambda J: _values(J)[:, -1],
        "the smallest singular value",
    ),
    Mistake(
        "largest-singular-value",
        "this is the largest singular value, the norm of J",
        lambda J: _values(J)[:, 0],
        "the largest singular value",
    ),
    Mistake(
        "sum-of-singular-values",
        "the singular values are added; they have to be multiplied",
        lambda J: _values(J).sum(axis=1),
        "the sum of the singular values",
    ),
    Mistake(
        "trace",
        "this comes from the trace, which is the sum; the determinant is asked for",
        lambda J: np.sqrt(np.trace(J @ transposed(J), axis1=1, axis2=2)),
        "the root of the trace",
    ),
    Mistake(
        "inverse-condition",
        "this is the smallest singular value over the largest one, another measure",
        lambda J: _values(J)[:, -1] / _values(J)[:, 0],
        "the inverse of the condition number",
    ),
    Mistake(
        "square-part",
        "this is the determinant of the first six columns; joint 7 counts too",
        lambda J: np.abs(np.linalg.det(J[:, :, :6])),
        "the determinant of six columns",
    ),
    Mistake(
        "position-only",
        "only the three v rows of J are used; the rotation counts too",
        lambda J: _values(J[:, 3:]).prod(axis=1),
        "the root of det(J J^T) of three rows",
    ),
    Mistake(
        "nan-at-a-singularity",
        "NaN comes back for some singular J: rounding leaves a bit less than 0 under "
        "the root there, so it has to be cut off at 0",
        _plain_root,
        "the root of det(J J^T), with its NaN,",
    ),
    Mistake(
        "nan-at-a-singularity",
        "NaN comes back for some singular J: rounding leaves a bit less than 0 under "
        "the root there, so it has to be cut off at 0",
        _root_of_eigenvalues,
        "the root of the eigenvalues' product, with its NaN,",
    ),
]


def _felt(J: Array, dq: Array) -> Array:
    return times(np.linalg.pinv(J), times(J, dq))


def _damped_projector(J: Array, dq: Array, damping: float) -> Array:
    return dq - damped(J, times(J, dq), damping**2 * np.eye(6))


def _projected(J: Array, dq: Array) -> Array:
    return dq - _felt(J, dq)


def _normalised(J: Array, dq: Array) -> Array:
    left = _projected(J, dq)
    return left / np.linalg.norm(left, axis=1, keepdims=True)


def _along_the_last(J: Array, dq: Array) -> Array:
    v = np.linalg.svd(J)[2][:, -1]
    return np.sum(v * dq, axis=1, keepdims=True) * v


NULL = [
    Mistake(
        "transpose-for-pseudo-inverse",
        "J^T stands where J^+ belongs: I - J^T J is no projector, and the hand feels "
        "it",
        lambda J, dq: dq - times(transposed(J), times(J, dq)),
        "dq - J^T J dq",
    ),
    Mistake(
        "felt-part",
        "this is the part that the hand does feel, J^+ J dq; the rest is asked for",
        _felt,
        "J^+ J dq",
    ),
    Mistake(
        "unchanged",
        "dq comes back as it was",
        lambda J, dq: dq,
        "dq itself",
    ),
    Mistake(
        "added",
        "the part that the hand feels is added; it has to be taken away",
        lambda J, dq: dq + _felt(J, dq),
        "dq + J^+ J dq",
    ),
    Mistake(
        "nothing-left",
        "nothing is left: seven joints always have a motion that the hand does not "
        "feel",
        lambda J, dq: np.zeros_like(dq),
        "zeros",
    ),
    *(
        Mistake(
            "damped-projector",
            f"the pseudo-inverse in it is damped (by {damping:g}), so a part of the "
            "felt motion stays",
            lambda J, dq, damping=damping: _damped_projector(J, dq, damping),
            "the projector with damping",
        )
        for damping in (0.05, 0.1, 0.01)
    ),
    Mistake(
        "normalised",
        "its length is made 1; the part of dq that the hand does not feel has a length "
        "of its own",
        _normalised,
        "the right one over its length",
    ),
    Mistake(
        "position-only",
        "only the three v rows of J are used: the hand stays where it is, but it turns",
        lambda J, dq: _projected(J[:, 3:], dq),
        "the projector of three rows",
    ),
    Mistake(
        "one-direction-only",
        "only the last right singular vector is kept. Where J is singular, there are "
        "more motions that the hand does not feel",
        _along_the_last,
        "dq along that vector",
    ),
]


def what_the_hand_feels(case: Case) -> Finding | None:
    """Return whether the hand feels the answer, and if not, what is wrong with it."""
    J, S, T = case.arguments[0], case.S, case.T
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
    off = difference(S, T)
    i = int(np.argmax(off))
    return Finding(
        "not-felt-but-off",
        "The hand does not feel it (J times your answer is 0), but it is not the part "
        f"of dq: its length is {np.linalg.norm(S[i]):.3g}, not "
        f"{np.linalg.norm(T[i]):.3g}.",
    )

"""Mistakes in tasks 3.5, 3.7 and 3.8: `dls_step`, `manipulability`, `null_step`.

`redo` takes J (n, 6, 7) with e (n, 6) and damping (n,), alone, or with dq (n, 7).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from robo47.checks import Array
from robo47.diagnose.matrices import times, transposed
from robo47.diagnose.mistake import Mistake

Function = Callable[..., Any]


def damped(J: Array, e: Array, squared: Array) -> Array:
    """Return J^T (J J^T + squared I)^-1 e, (n, 7); squared is (n, 1, 1) or a matrix."""
    y = np.linalg.solve(J @ transposed(J) + squared, e[..., None])
    return (transposed(J) @ y)[..., 0]


def _with(change: Function) -> Function:
    """Return the step with what change makes of the damping, (n, 1, 1), on I."""
    return lambda J, e, damping: damped(
        J, e, change(damping[:, None, None]) * np.eye(6)
    )


DLS = [
    Mistake(
        "damping-not-squared",
        "the damping is not squared",
        _with(np.positive),
        "the step with damping I",
    ),
    Mistake(
        "damping-dropped",
        "there is no damping in it: this is the plain pseudo-inverse, which is huge "
        "near a singularity",
        lambda J, e, damping: times(np.linalg.pinv(J), e),
        "the step of the pseudo-inverse",
    ),
    Mistake(
        "damping-doubled",
        "the damping is multiplied by 2, not by itself",
        _with(lambda damping: 2.0 * damping),
        "the step with 2 damping I",
    ),
    Mistake(
        "damping-halved",
        "half of the squared damping is added, not all of it",
        _with(lambda damping: 0.5 * damping**2),
        "the step with half of it",
    ),
    Mistake(
        "damping-everywhere",
        "damping^2 is added to every entry of J J^T; it belongs on the diagonal only",
        lambda J, e, damping: damped(J, e, damping[:, None, None] ** 2),
        "the step with damping^2 in every entry",
    ),
    Mistake(
        "transpose-only",
        "this is J^T e: the inverse is missing, so the step has the wrong length and "
        "direction",
        lambda J, e, damping: times(transposed(J), e),
        "J^T e",
    ),
    Mistake(
        "identity-scaled",
        "this is J^T e over damping^2: J J^T is left out",
        lambda J, e, damping: times(transposed(J), e) / damping[:, None] ** 2,
        "J^T e / damping^2",
    ),
    Mistake(
        "pseudo-inverse-scaled",
        "the plain step is divided by 1 + damping^2; damping changes the directions "
        "near a singularity most",
        lambda J, e, damping: (
            times(np.linalg.pinv(J), e) / (1.0 + damping[:, None] ** 2)
        ),
        "the plain step over 1 + damping^2",
    ),
]


def _determinant(J: Array) -> Array:
    return np.linalg.det(J @ transposed(J))


def _values(J: Array) -> Array:
    return np.linalg.svd(J, compute_uv=False)


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
]


def _felt(J: Array, dq: Array) -> Array:
    return times(np.linalg.pinv(J), times(J, dq))


def _damped_projector(J: Array, dq: Array, damping: float) -> Array:
    return dq - damped(J, times(J, dq), damping**2 * np.eye(6))


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
]

"""Mistakes in task 3.5: `dls_step(J, e, damping)`.

`redo` takes J (n, 6, 7), e (n, 6) and damping (n,).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import times, transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array

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


def _by_singular_values(weight: Function) -> Function:
    """Return the step with other weights, made of the singular values and damping."""

    def redo(J: Array, e: Array, damping: Array) -> Array:
        U, values, Vt = np.linalg.svd(J, full_matrices=False)
        along = times(transposed(U), e) * weight(values, damping[:, None])
        return times(transposed(Vt), along)

    return redo


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
    Mistake(
        "damping-squared-twice",
        "the damping is squared twice: its fourth power is added",
        _with(lambda damping: damping**4),
        "the step with damping^4 I",
    ),
    Mistake(
        "damping-fixed",
        "the damping is 0.05 whatever the argument says",
        _with(lambda damping: np.full_like(damping, 0.05**2)),
        "the step with damping 0.05",
    ),
    Mistake(
        "damping-added-to-the-values",
        "the damping is added to each singular value s, 1 / (s + damping); the formula "
        "makes s / (s^2 + damping^2) of it",
        _by_singular_values(lambda s, d: 1.0 / (s + d)),
        "the step with 1 / (s + damping)",
    ),
    Mistake(
        "singular-value-missing",
        "the weights are 1 / (s^2 + damping^2) for the singular values s: J^T in front "
        "puts one more s above",
        _by_singular_values(lambda s, d: 1.0 / (s * s + d * d)),
        "the step with 1 / (s^2 + damping^2)",
    ),
]

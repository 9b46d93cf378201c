"""Mistakes in task 4.9 `energy`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array

from .gravity import OTHER_GRAVITY


def _times(M: Array, x: Array) -> Array:
    return (M @ x[..., None])[..., 0]


def _moving(M: Array, qd: Array) -> Array:
    return 0.5 * np.sum(qd * _times(M, qd), axis=-1)


def _lifted(masses: Array, coms: Array, g: Array) -> Array:
    return -np.einsum("nl,nla,na->n", masses, coms, g)


def _both(
    kinetic: Callable[..., Array] = _moving, potential: Callable[..., Array] = _lifted
) -> Callable[..., Array]:
    def redo(M: Array, qd: Array, masses: Array, coms: Array, g: Array) -> Array:
        return np.stack([kinetic(M, qd), potential(masses, coms, g)], axis=-1)

    return redo


def _total_mass(m: Array, coms: Array, g: Array) -> Array:
    return -m.sum(-1) * np.einsum("nla,na->n", coms, g)


ENERGY = [
    Mistake(
        "half-forgotten",
        "the kinetic energy has no 1/2",
        _both(lambda M, qd: 2 * _moving(M, qd)),
        "the answer with twice as much",
    ),
    Mistake(
        "potential-sign",
        "the potential energy has the wrong sign: g points down, and what is lifted "
        "gains",
        _both(potential=lambda *given: -_lifted(*given)),
        "the answer with that sign",
    ),
    Mistake(
        "diagonal-only",
        "the kinetic energy takes only the diagonal of M; the joints share their links",
        _both(lambda M, qd: _moving(M * np.eye(M.shape[-1]), qd)),
        "the answer with the diagonal",
    ),
    Mistake(
        "speed-squared-too-early",
        "qd is squared before M is applied; qd stands on both sides of M",
        _both(lambda M, qd: 0.5 * _times(M, qd**2).sum(-1)),
        "the answer with M qd^2",
    ),
    Mistake(
        "mass-matrix-forgotten",
        "the kinetic energy takes no mass: M is missing",
        _both(lambda M, qd: 0.5 * (qd**2).sum(-1)),
        "the answer with qd.qd / 2",
    ),
    Mistake(
        "masses-forgotten",
        "the potential energy takes no masses",
        _both(potential=lambda m, c, g: _lifted(np.ones_like(m), c, g)),
        "the answer with 1 kg each",
    ),
    Mistake(
        "every-mass-everywhere",
        "every link's centre is multiplied by the whole arm's mass",
        _both(potential=_total_mass),
        "the answer with the total mass",
    ),
    Mistake(
        "order-swapped",
        "potential energy comes first; kinetic was asked for first",
        lambda *given: _both()(*given)[:, ::-1],
        "the two swapped",
    ),
    *(
        Mistake(
            slug,
            says,
            _both(potential=lambda m, c, g, pull=pull: _lifted(m, c, pull(g))),
            "the answer with that gravity",
        )
        for slug, says, pull in OTHER_GRAVITY
    ),
]

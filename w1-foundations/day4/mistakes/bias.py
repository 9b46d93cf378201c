"""Mistakes in task 4.7 `bias_torque`: those of 4.6 at qdd = 0, and its own."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array
from robo47.screws import ad

from .forces import SHARED, plain
from .mass import LINKS
from .passes import RIGHT, outwards, times

# What 4.6 says of its own inside, said of the call: 4.6 is right when 4.7 is judged.
_OF_THE_CALL = {
    "base-acceleration-sign": "gravity has the wrong sign, as if g were given as -g; "
    "inverse_dynamics wants g as it is",
    "gravity-forgotten": "gravity is missing, as if g were given as 0; it is part of "
    "the bias",
    "gravity-twice": "gravity counts twice; inverse_dynamics has it already",
}


def _rate_of_M(J: Array, G: Array, qd: Array) -> Array:
    """Return what M changes by per second times qd, from G's and J's own rates."""
    S = transposed(J)
    V = outwards(S * qd[..., None])
    ad_V = ad(V)
    J_rate = transposed(times(ad_V, S))
    G_rate = -transposed(ad_V) @ G - G @ ad_V
    up, down = LINKS(J + J_rate, G), LINKS(J - J_rate, G)
    return times(0.5 * (up - down) + LINKS(J, G_rate), qd)


def _without_qdd(mistake: Mistake) -> Mistake:
    """Return a mistake of inverse_dynamics as one of bias_torque."""
    redo = mistake.redo
    return replace(
        mistake,
        says=_OF_THE_CALL.get(mistake.slug, mistake.says),
        redo=lambda J, G, qd, g: redo(J, G, qd, np.zeros_like(qd), g),
    )


def _coriolis(factor: float) -> Callable[..., Array]:
    """Return the bias with Coriolis and centrifugal torques times a factor."""

    def redo(J: Array, G: Array, qd: Array, g: Array) -> Array:
        rest = RIGHT(J, G, 0 * qd, 0 * qd, g)
        return rest + factor * (RIGHT(J, G, qd, 0 * qd, g) - rest)

    return redo


BIAS_TORQUE = [
    *map(_without_qdd, SHARED),
    *plain([
        (
            "gravity-only",
            "qd is not used: Coriolis and centrifugal forces are missing",
            lambda J, G, qd, g: RIGHT(J, G, 0 * qd, 0 * qd, g),
        ),
        (
            "coriolis-twice",
            "Coriolis and centrifugal forces count twice; gravity is right",
            _coriolis(2.0),
        ),
        (
            "coriolis-half",
            "only half of the Coriolis and centrifugal forces is there; gravity is "
            "right",
            _coriolis(0.5),
        ),
        (
            "speed-for-acceleration",
            "qd is given as the acceleration, too; that has to be 0",
            lambda J, G, qd, g: RIGHT(J, G, qd, qd, g),
        ),
        (
            "speed-in-place-of-acceleration",
            "qd is given as the acceleration, and 0 as the speed",
            lambda J, G, qd, g: RIGHT(J, G, 0 * qd, qd, g),
        ),
        (
            "acceleration-of-one",
            "the acceleration is 1 for every joint; it has to be 0",
            lambda J, G, qd, g: RIGHT(J, G, qd, np.ones_like(qd), g),
        ),
        (
            "rate-of-the-mass-matrix",
            "the rate of M times qd is not the Coriolis torque: half of what it holds "
            "belongs there",
            lambda J, G, qd, g: RIGHT(J, G, 0 * qd, 0 * qd, g) + _rate_of_M(J, G, qd),
        ),
        (
            "damping-added",
            "the damping's 1.0 qd is in it; MuJoCo keeps it apart, and so does 4.8",
            lambda J, G, qd, g: RIGHT(J, G, qd, 0 * qd, g) + qd,
        ),
    ]),
]  # fmt: skip

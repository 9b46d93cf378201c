"""Mistakes in tasks 4.6 `inverse_dynamics` and 4.7 `bias_torque`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from robo47.checks import Array
from robo47.diagnose.matrices import transposed
from robo47.diagnose.mistake import Mistake, lifted
from robo47.screws import ad

from .brackets import AD
from .gravity import OTHER_GRAVITY
from .mass import LINKS
from .passes import (
    RIGHT,
    beyond,
    inwards,
    itself,
    outwards,
    times,
    torque,
    velocity_product,
)


def _velocity_before(J: Array, G: Array, qd: Array, qdd: Array, g: Array) -> Array:
    """Return the torque where F takes V of the link before."""
    S = transposed(J) * qd[..., None]
    before = outwards(S) - S
    F = velocity_product(ad(before), times(G, before)) - velocity_product(
        ad(outwards(S)), times(G, outwards(S))
    )
    return RIGHT(J, G, qd, qdd, g) + np.sum(transposed(J) * inwards(F), axis=-1)


def _plain(parts: list[tuple[str, str, Callable[..., Array]]]) -> list[Mistake]:
    return [Mistake(slug, says, redo, "the torque so") for slug, says, redo in parts]


# Wrong whatever qdd is: mistakes of bias_torque, too.
_SHARED = _plain([
    (
        "base-acceleration-sign",
        "the base accelerates the wrong way: to stand still on the ground feels like a "
        "lift going up, against g",
        torque(base=lambda g: np.hstack([0 * g, g])),
    ),
    (
        "gravity-forgotten",
        "gravity is missing: the acceleration starts at 0 at the base",
        torque(base=lambda g: np.hstack([0 * g, 0 * g])),
    ),
    (
        "gravity-as-omega",
        "the base's acceleration stands in the angular half; a twist is (omega; v)",
        torque(base=lambda g: np.hstack([-g, 0 * g])),
    ),
    (
        "gravity-at-every-link",
        "gravity is added again at every link; the sum carries it from the base to all",
        torque(every_link=True),
    ),
    (
        "bracket-forgotten",
        "the acceleration lacks ad(V) S qd: a joint that is carried round changes its "
        "direction",
        torque(turned=0.0),
    ),
    (
        "bracket-sign",
        "in the acceleration ad(V) S qd has the wrong sign",
        torque(turned=-1.0),
    ),
    (
        "bracket-twice",
        "in the acceleration ad(V) S qd counts twice",
        torque(turned=2.0),
    ),
    (
        "bracket-not-transposed",
        "the force has ad in place of its transpose: a wrench changes the other way "
        "from a twist",
        torque(swing=lambda ad_V, h: -times(ad_V, h)),
    ),
    (
        "bracket-not-transposed",
        "the force has ad in place of minus its transpose: a wrench changes the other "
        "way from a twist",
        torque(swing=times),
    ),
    (
        "velocity-product-sign",
        "the velocity product, ad(V)^T G V, is added to the force; it is taken off",
        torque(swing=lambda ad_V, h: -velocity_product(ad_V, h)),
    ),
    (
        "velocity-product-forgotten",
        "the force is G A alone: that the inertia itself moves is missing",
        torque(swing=lambda ad_V, h: 0 * h),
    ),
    (
        "velocity-of-the-link-before",
        "the force uses V before the link's own joint has been added",
        _velocity_before,
    ),
    (
        "not-summed-back",
        "each motor feels its own link only; it carries all links beyond it, too",
        torque(wrenches=itself),
    ),
    (
        "summed-from-the-base",
        "the forces are summed from the base to the tip; a motor feels what is beyond "
        "it, so the sum starts at the tip",
        torque(wrenches=outwards),
    ),
    (
        "own-link-left-out",
        "each motor feels the links beyond its own, but not its own",
        torque(wrenches=beyond),
    ),
    (
        "velocities-not-added",
        "the velocity of a link is that of its own joint alone; the joints before move "
        "it, too",
        torque(speeds=itself),
    ),
    (
        "accelerations-not-added",
        "the acceleration of a link is that of its own joint alone; the joints before "
        "move it, too",
        torque(rates=itself),
    ),
    (
        "nothing-added-outwards",
        "V and A start anew at every link; along the arm they add up",
        torque(speeds=itself, rates=itself),
    ),
    (
        "negative",
        "the sign is wrong: this is what the arm does to the motors",
        lambda *given: -RIGHT(*given),
    ),
])  # fmt: skip
_SHARED += lifted(AD, "in ad, ", lambda bracket: torque(bracket=bracket))
_SHARED += [
    Mistake(
        slug,
        says,
        lambda J, G, qd, qdd, g, pull=pull: RIGHT(J, G, qd, qdd, pull(g)),
        "the torque with that gravity",
    )
    for slug, says, pull in OTHER_GRAVITY
]

INVERSE_DYNAMICS = [
    *_SHARED,
    *_plain([
        (
            "speed-and-acceleration-swapped",
            "qd and qdd have changed places",
            lambda J, G, qd, qdd, g: RIGHT(J, G, qdd, qd, g),
        ),
        (
            "acceleration-ignored",
            "qdd is not used: this is the bias alone",
            lambda J, G, qd, qdd, g: RIGHT(J, G, qd, 0 * qdd, g),
        ),
        (
            "speed-ignored",
            "qd is not used: Coriolis and centrifugal forces are missing",
            lambda J, G, qd, qdd, g: RIGHT(J, G, 0 * qd, qdd, g),
        ),
        (
            "gravity-only",
            "neither qd nor qdd is used: this is the torque that holds the arm",
            lambda J, G, qd, qdd, g: RIGHT(J, G, 0 * qd, 0 * qdd, g),
        ),
        (
            "armature-added",
            "the armature's 0.1 qdd is in it; the task is about the links alone",
            lambda J, G, qd, qdd, g: RIGHT(J, G, qd, qdd, g) + 0.1 * qdd,
        ),
        (
            "damping-added",
            "the damping's 1.0 qd is in it; the task is about the links alone",
            lambda J, G, qd, qdd, g: RIGHT(J, G, qd, qdd, g) + qd,
        ),
        (
            "armature-and-damping-added",
            "armature and damping are in it, 0.1 qdd and 1.0 qd; the task is about the "
            "links alone",
            lambda J, G, qd, qdd, g: RIGHT(J, G, qd, qdd, g) + 0.1 * qdd + qd,
        ),
    ]),
]  # fmt: skip


def _rate_of_M(J: Array, G: Array, qd: Array) -> Array:
    """Return what M changes by per second times qd, from G's and J's own rates."""
    S = transposed(J)
    V = outwards(S * qd[..., None])
    ad_V = ad(V)
    J_rate = transposed(times(ad_V, S))
    G_rate = -transposed(ad_V) @ G - G @ ad_V
    up, down = LINKS(J + J_rate, G), LINKS(J - J_rate, G)
    return times(0.5 * (up - down) + LINKS(J, G_rate), qd)


def _at_rest(mistake: Mistake) -> Mistake:
    """Return a mistake of inverse_dynamics as one of bias_torque."""
    redo = mistake.redo
    return replace(
        mistake, redo=lambda J, G, qd, g: redo(J, G, qd, np.zeros_like(qd), g)
    )


BIAS_TORQUE = [
    *map(_at_rest, _SHARED),
    *_plain([
        (
            "gravity-only",
            "qd is not used: Coriolis and centrifugal forces are missing",
            lambda J, G, qd, g: RIGHT(J, G, 0 * qd, 0 * qd, g),
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

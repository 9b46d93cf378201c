"""Mistakes in task 4.6 `inverse_dynamics`, most of them of 4.7 `bias_torque`, too."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array

from .brackets import AD
from .gravity import OTHER_GRAVITY
from .passes import (
    RIGHT,
    beyond,
    everything,
    gravity_at_base_and_links,
    itself,
    outwards,
    times,
    torque,
    velocity_before,
    velocity_product,
)


def plain(parts: list[tuple[str, str, Callable[..., Array]]]) -> list[Mistake]:
    """Return mistakes from (slug, says, redo)."""
    return [Mistake(slug, says, redo, "the torque so") for slug, says, redo in parts]


# Wrong whatever qdd is: mistakes of bias_torque, too.
SHARED = plain([
    (
        "base-acceleration-sign",
        "the base accelerates the wrong way: to stand still on the ground feels like a "
        "lift that starts upwards, against g",
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
        "gravity-at-every-link",
        "gravity is added at the base and again at every link; the sum carries it from "
        "the base to all",
        gravity_at_base_and_links,
    ),
    (
        "gravity-twice",
        "gravity counts twice: it is in A from the base on, so the wrench needs no "
        "weight",
        lambda J, G, qd, qdd, g: RIGHT(J, G, qd, qdd, 2 * g),
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
        "in the acceleration ad(V) S qd stands twice; it needs no 2, since the force "
        "brings the other half of Coriolis",
        torque(turned=2.0),
    ),
    (
        "bracket-without-speed",
        "the acceleration has ad(V) S without qd: a joint at rest would change it, "
        "too",
        torque(joint=lambda S, qd: S),
    ),
    (
        "speed-squared",
        "the acceleration has ad(V) S qd^2; one of the two speeds is in V already",
        torque(joint=lambda S, qd: S * qd[..., None] ** 2),
    ),
    (
        "speed-sign-lost",
        "the speeds qd are taken without their signs: which way a joint turns counts "
        "when another one turns as well",
        lambda J, G, qd, qdd, g: RIGHT(J, G, np.abs(qd), qdd, g),
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
        "acceleration-in-the-velocity-product",
        "the velocity product has G A; what the motion of the link changes is its "
        "momentum, G V",
        torque(moving=lambda V, A: A),
    ),
    (
        "velocity-product-forgotten",
        "the force is G A alone: that the inertia itself moves is missing",
        torque(swing=lambda ad_V, h: 0 * h),
    ),
    (
        "velocity-of-the-link-before",
        "the force uses V before the link's own joint has been added",
        velocity_before,
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
        "every-link-for-all",
        "each motor feels all seven links; it carries its own and those beyond it only",
        torque(wrenches=everything),
    ),
    (
        "moment-only",
        "each motor feels the moments about the world's origin alone; where its axis "
        "does not go through that point, the force counts, too: all six numbers of S",
        torque(felt=np.repeat([1.0, 0.0], 3)),
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
        "accelerations-not-added",
        "A is set anew at every link, so what the joints before gave, and gravity, are "
        "lost; it adds up, as V does",
        torque(rates=itself, base=lambda g: np.hstack([0 * g, 0 * g])),
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
# In ad an identity cancels: what it adds to G A, it takes from the velocity product.
_IN_AD = [mistake for mistake in AD if mistake.slug != "identity-added"]
SHARED += lifted(_IN_AD, "in ad, ", lambda bracket: torque(bracket=bracket))
SHARED += [
    Mistake(
        slug,
        says,
        lambda J, G, qd, qdd, g, pull=pull: RIGHT(J, G, qd, qdd, pull(g)),
        "the torque with that gravity",
    )
    for slug, says, pull in OTHER_GRAVITY
]

INVERSE_DYNAMICS = [
    *SHARED,
    *plain([
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

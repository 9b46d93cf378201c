"""Mistakes in task 7.9 `heaviest_cube(grip, mu, acceleration)`."""

import numpy as np

from labkit.judge.mistake import Mistake

G = 9.81
CUBE = [
    Mistake(
        "one-finger",
        "one finger's friction is missing: two faces hold the cube",
        lambda grip, mu, a: mu * grip / (G + a),
        "half of it",
    ),
    Mistake(
        "acceleration-forgotten",
        "the cube's acceleration does not count; while it speeds up it needs more",
        lambda grip, mu, a: 2 * mu * grip / G,
        "the mass at rest",
    ),
    Mistake(
        "acceleration-sign",
        "the acceleration is taken off gravity; upwards it comes on top",
        lambda grip, mu, a: 2 * mu * grip / (G - a),
        "the mass with g - a",
    ),
    Mistake(
        "gravity-forgotten",
        "gravity is missing: at rest nothing would have to be lifted",
        lambda grip, mu, a: 2 * mu * grip / a,
        "the mass without gravity",
    ),
    Mistake(
        "weight-for-mass",
        "this is the force in newtons; the mass is that force over g + a",
        lambda grip, mu, a: 2 * mu * grip,
        "the friction's force",
    ),
    Mistake(
        "friction-forgotten",
        "friction does not count; without mu nothing is lifted",
        lambda grip, mu, a: 2 * grip / (G + a) + 0.0 * mu,
        "the mass with mu = 1",
    ),
    Mistake(
        "divided-by-friction",
        "the friction mu stands below the line; more friction lifts more",
        lambda grip, mu, a: 2 * grip / (mu * (G + a)),
        "the mass with 1 / mu",
    ),
    Mistake(
        "gravity-negative",
        "gravity has the wrong sign here: its z is -9.81, and it pulls down",
        lambda grip, mu, a: 2 * mu * grip / (a - G),
        "the mass with -9.81",
    ),
    Mistake(
        "acceleration-without-sign",
        "the acceleration's sign is lost: downwards, it takes weight off the fingers",
        lambda grip, mu, a: 2 * mu * grip / (G + np.abs(a)),
        "the mass with |a|",
    ),
    Mistake(
        "acceleration-without-sign",
        "an acceleration downwards does not count; it takes weight off the fingers",
        lambda grip, mu, a: 2 * mu * grip / (G + np.maximum(a, 0.0)),
        "the mass with max(a, 0)",
    ),
    *(
        Mistake(
            "another-gravity",
            f"gravity is {g} m/s2 here; the lab's GRAVITY says 9.81",
            lambda grip, mu, a, g=g: 2 * mu * grip / (g + a),
            f"the mass with {g}",
        )
        for g in (9.8, 10, 9.80665)
    ),
]

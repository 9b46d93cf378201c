"""7.9 `max_cube_mass(grip, mu, acceleration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar, rounded

G = 9.81

row = Row(Scalar(unit="kg", scale=0.1))


@row.inputs
def _(rng):
    drawn = rng.numbers(0.1, 1.0, 9, 3) * [8.0, 1.5, 4.0]
    down = [(6.0, 1.4, -2.5), (3.0, 0.5, -6.0)]
    return [(0.9247, 1.0, 0.0), *down, *map(tuple, rounded(drawn).tolist())]


@row.wrongs
def _(grip, mu, acceleration):
    """one-finger: one finger's friction is missing: two faces hold the cube
    acceleration-forgotten: the cube's acceleration does not count; while it speeds up
      it needs more => the mass at rest
    acceleration-sign: the acceleration is taken off gravity; upwards it comes on top =>
      the mass with g - a
    gravity-forgotten: gravity is missing: at rest nothing would have to be lifted
    weight-for-mass: this is the force in newtons; the mass is that force over g + a
    friction-forgotten: friction does not count; without mu nothing is lifted => the
      mass with mu = 1
    divided-by-friction: the friction mu stands below the line; more friction lifts more
      => the mass with 1 / mu
    gravity-negative: gravity has the wrong sign here: its z is -9.81, and it pulls down
    acceleration-without-sign: the acceleration's sign is lost: downwards, it takes
      weight off the fingers => the mass with |a|
    acceleration-without-sign 2: an acceleration downwards does not count; it takes
      weight off the fingers => the mass with max(a, 0)
    """
    return {
        "one-finger": mu * grip / (G + acceleration),
        "acceleration-forgotten": 2 * mu * grip / G,
        "acceleration-sign": 2 * mu * grip / (G - acceleration),
        "gravity-forgotten": np.divide(2 * mu * grip, acceleration),
        "weight-for-mass": 2 * mu * grip,
        "friction-forgotten": 2 * grip / (G + acceleration),
        "divided-by-friction": 2 * grip / (mu * (G + acceleration)),
        "gravity-negative": 2 * mu * grip / (acceleration - G),
        "acceleration-without-sign": 2 * mu * grip / (G + abs(acceleration)),
        "acceleration-without-sign 2": 2 * mu * grip / (G + max(acceleration, 0.0)),
    }


for g in (9.8, 10, 9.80665):

    @row.wrong(
        "another-gravity",
        f"gravity is {g} m/s2 here; the lab's GRAVITY says 9.81",
        f"the mass with {g}",
    )
    def _(grip, mu, acceleration, g=g):
        return 2 * mu * grip / (g + acceleration)


row.at_least_0(
    grip="a force that presses",
    mu="a friction coefficient",
    answer="a mass",
)


row.spans(  # as small, or as large, as in the lab
    grip=(0.2,),
    mu=(0.03,),
    acceleration=(0.05,),
)

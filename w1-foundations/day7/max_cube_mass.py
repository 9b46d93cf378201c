"""7.9 `max_cube_mass(grip, mu, acceleration)`: its questions and its mistakes."""

from labkit.judge import Row, Scalar, rounded

G = 9.81

row = Row(Scalar(unit="kg", scale=0.1))


@row.inputs
def _(rng):
    drawn = rng.numbers(0.1, 1.0, 9, 3) * [8.0, 1.5, 4.0]
    down = [(6.0, 1.4, -2.5), (3.0, 0.5, -6.0)]
    return [(0.9247, 1.0, 0.0), *down, *map(tuple, rounded(drawn).tolist())]


@row.wrong(
    "one-finger",
    "your code includes the friction of only one finger. Include both fingers, because "
    "each finger presses on a face of the cube",
)
def _(grip, mu, acceleration):
    return mu * grip / (G + acceleration)


for g in (9.8, 10, 9.80665):

    @row.wrong(
        "another-gravity",
        f"your code uses {g} m/s2 as the acceleration of gravity. Use the lab's "
        "`GRAVITY`, whose norm is 9.81 m/s2",
    )
    def _(grip, mu, acceleration, g=g):
        return 2 * mu * grip / (g + acceleration)


row.at_least_0(
    grip="a normal force is not negative",
    mu="a friction coefficient is not negative",
    answer="a mass is not negative",
)


row.spans(  # as small, or as large, as in the lab
    grip=(0.2,),
    mu=(0.03,),
    acceleration=(0.05,),
)

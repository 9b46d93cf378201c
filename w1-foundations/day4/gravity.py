"""Another gravity than the argument g, in each function that takes it."""

import numpy as np

from labkit.judge.argument_mistakes import Change


def typed_in(z):
    """Return what is used in place of any g."""
    return lambda g: np.array([0.0, 0.0, z])


UPRIGHT = "the lab's robot stands upright"
OTHER_GRAVITY = (
    Change(
        "gravity-typed-in",
        "9.81 downwards is typed in; gravity is the argument {name}, and the robot may "
        "hang on a wall",
        typed_in(-9.81),
        hidden=UPRIGHT,
    ),
    Change(
        "gravity-typed-in",
        "9.81 is typed in, and with the wrong sign; gravity is the argument {name}",
        typed_in(9.81),
    ),
    Change(
        "gravity-rounded",
        "9.8 is typed in for 9.81, and {name} is not looked at",
        typed_in(-9.8),
    ),
    Change(
        "gravity-rounded",
        "9.80665 is typed in, and {name} is not looked at",
        typed_in(-9.80665),
    ),
    Change(
        "only-z-of-gravity",
        "only the z of {name} counts; it is a vector, and need not point down",
        lambda g: g * [0.0, 0.0, 1.0],
        hidden=UPRIGHT,
    ),
    Change(
        "length-of-gravity",
        "only the length of {name} counts, always downwards; it says where down is",
        lambda g: np.array([0.0, 0.0, -np.linalg.norm(g)]),
        hidden=UPRIGHT,
    ),
)

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
        "your code uses the constant (0, 0, 9.81) for gravity, which points up. Use "
        "the argument `{name}` instead",
        typed_in(9.81),
    ),
    Change(
        "gravity-rounded",
        "your code uses the rounded constant 9.8 for gravity. Use the argument "
        "`{name}` instead",
        typed_in(-9.8),
    ),
)
# The matcher finds these where the function has no recursion along the arm.
OTHER_DIRECTION = (
    Change(
        "gravity-typed-in",
        "your code uses the constant (0, 0, -9.81) for gravity. Use the argument "
        "`{name}` instead, because the robot may be mounted on a wall",
        typed_in(-9.81),
        hidden=UPRIGHT,
    ),
    Change(
        "only-z-of-gravity",
        "your code uses only the z component of `{name}`. Use all three components, "
        "because `{name}` can point in any direction",
        lambda g: g * [0.0, 0.0, 1.0],
        hidden=UPRIGHT,
    ),
    Change(
        "length-of-gravity",
        "your code uses only the norm of `{name}` and assumes that gravity points "
        "down. Use the direction of `{name}` as well",
        lambda g: np.array([0.0, 0.0, -np.linalg.norm(g)]),
        hidden=UPRIGHT,
    ),
)

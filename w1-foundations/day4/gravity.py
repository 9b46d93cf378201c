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
        "gravity is typed in with the wrong sign; use the argument {name}",
        typed_in(9.81),
    ),
    Change(
        "gravity-rounded",
        "gravity is typed in as 9.8; use the argument {name}",
        typed_in(-9.8),
    ),
)
# The matcher finds these where the function has no recursion along the arm.
OTHER_DIRECTION = (
    Change(
        "gravity-typed-in",
        "gravity is typed in as (0, 0, -9.81); use the argument {name}, because the "
        "robot may hang on a wall",
        typed_in(-9.81),
        hidden=UPRIGHT,
    ),
    Change(
        "only-z-of-gravity",
        "only the z component of {name} is used; {name} need not point down",
        lambda g: g * [0.0, 0.0, 1.0],
        hidden=UPRIGHT,
    ),
    Change(
        "length-of-gravity",
        "only the norm of {name} is used, always downwards; use its direction as well",
        lambda g: np.array([0.0, 0.0, -np.linalg.norm(g)]),
        hidden=UPRIGHT,
    ),
)

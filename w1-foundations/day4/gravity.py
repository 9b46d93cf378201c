"""Another gravity than the argument g, in each function that takes it."""

import numpy as np

from labkit.judge.argument_mistakes import Change

UPRIGHT = "the lab's robot stands upright"
OTHER = (
    (
        "gravity-typed-in",
        "9.81 downwards is typed in; gravity is the argument g, and the robot may hang "
        "on a wall",
        lambda g: np.array([0.0, 0.0, -9.81]),
        UPRIGHT,
    ),
    (
        "gravity-typed-in",
        "9.81 is typed in, and with the wrong sign; gravity is the argument g",
        lambda g: np.array([0.0, 0.0, 9.81]),
        "",
    ),
    (
        "gravity-rounded",
        "9.8 is typed in for 9.81, and g is not looked at",
        lambda g: np.array([0.0, 0.0, -9.8]),
        "",
    ),
    (
        "gravity-rounded",
        "9.80665 is typed in, and g is not looked at",
        lambda g: np.array([0.0, 0.0, -9.80665]),
        "",
    ),
    (
        "only-z-of-gravity",
        "only the z of g counts; it is a vector, and need not point down",
        lambda g: g * [0.0, 0.0, 1.0],
        UPRIGHT,
    ),
    (
        "length-of-gravity",
        "only the length of g counts, always downwards; g says where down is",
        lambda g: np.array([0.0, 0.0, -np.linalg.norm(g)]),
        UPRIGHT,
    ),
)


def other_gravity(redone):
    """Return the changes of g; `redone` is what to call the answer with one."""
    return [Change(slug, says, code, redone, hid) for slug, says, code, hid in OTHER]

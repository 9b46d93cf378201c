"""Seven joints: the errors, gains and torques in the questions of Day 5."""

import numpy as np

from labkit.judge import HeldOut, Vector
from labkit.judge.argument_mistakes import Change

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TORQUE = Vector((7,), "N m", scale=10.0, names=JOINTS)
ANGLE = Vector((7,), "rad", names=JOINTS)
ONE = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
TWO_NUMBERS = "kp and kd are single numbers, such as the lab's KP and KD"
BEYOND = 3.7 * np.array([1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0])  # half a turn


def one_gain(inputs, many="kp and kd have 7 entries each", one=TWO_NUMBERS):
    """Return the question whether a right function also takes one number as a gain."""

    def says(failing=(), usual=()):
        stops = any(call.reply.kind for call in failing)
        how = "stops with an error" if stops else "is wrong"
        return (
            f"Your function is correct if {many}. It {how} if {one}. A single number "
            "has no index and no `@`. Which operation accepts both arrays and single "
            "numbers?"
        )

    return HeldOut("one-number-as-gain", says(), inputs, told=says)


def wrapped(angle):
    """Return angles wrapped to -pi..pi."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


WRAPPED = Change(
    "error-wrapped",
    "your code wraps {name} to [-pi, pi]. Use {name} unchanged, because e and e + 2 "
    "pi are different errors for a joint with limits",
    wrapped,
    hidden="no error there exceeds half a turn",
)


def seven(rng, low, high):
    """Return seven numbers, rounded."""
    return rng.numbers(low, high, 7)


def errors(rng):
    """Return an error of the angles, and one of the velocities."""
    return seven(rng, -0.3, 0.3), seven(rng, -2, 2)


def far(rng):
    """Return errors beyond half a turn in some joints, on both sides."""
    e, ed = errors(rng)
    return e + BEYOND, ed


def stiff(rng):
    """Return kp and kd, seven of each."""
    return seven(rng, 50, 600), seven(rng, 5, 50)


def springs(rng):
    """Return errors and gains; the second errors are beyond half a turn."""
    ranges = (-0.3, 0.3), (-2, 2), (50, 600), (5, 50)
    e, ed, kp, kd = [rng.numbers(*ends, 10, 7) for ends in ranges]
    e[0] += BEYOND
    return [
        (0.1 * ONE, 0.0 * ONE, np.full(7, 100.0), np.full(7, 20.0)),
        *zip(e, ed, kp, kd, strict=True),
    ]


def springs_of_one_gain(rng):
    """Return errors, and gains that are one number for all joints."""
    return [(*errors(rng), *gains) for gains in ((100.0, 20.0), (87.5, 12.5))]

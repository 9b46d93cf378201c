"""Mistakes made with one argument before it is used, whatever function takes it.

A day's file picks those that make a difference, or gives them a name of its own:

    row.of_argument("q", LEFT_OUT, FIRST_FOR_ALL.called("first-motor-for-all"))
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from labkit.judge.mistake import Mistake


@dataclass(frozen=True)
class Change(Mistake):
    """A mistake with one argument, which `redo` takes; {name} in its texts is its."""

    hidden: str = ""  # why the lab cannot show it, "" where it can

    def called(self, slug: str) -> "Change":
        """Return the same mistake under another name."""
        return replace(self, slug=slug)


def _only(some: slice, x: Any) -> Any:
    """Return x with some entries kept and 0 for the others."""
    kept = np.zeros_like(x)
    kept[some] = x[some]
    return kept


# Angles.
DEGREES = Change(
    "degrees",
    "your code converts `{name}` to degrees. Use `{name}` unchanged, because sine "
    "and cosine take radians",
    np.rad2deg,
)
RADIANS_TWICE = Change(
    "radians-taken-for-degrees",
    "your code converts `{name}` from degrees to radians. Use `{name}` unchanged, "
    "because it is already in radians",
    np.deg2rad,
)
INTO_COS = DEGREES.called("degrees-into-cos")
OF_AN_ANGLE = (
    INTO_COS,
    RADIANS_TWICE,
    Change(
        "half-angle",
        "your code rotates by half of `{name}`. The correct rotation is by `{name}` "
        "itself",
        lambda x: x / 2,
    ),
    Change(
        "double-angle",
        "your code rotates by twice `{name}`. The correct rotation is by `{name}` "
        "itself",
        lambda x: 2 * x,
    ),
)

# Signs.
NEGATED = Change(
    "{name}-sign", "your code uses `{name}` with the wrong sign", np.negative
)
BACKWARDS = Change(
    "all-backwards",
    "your code rotates every joint in the opposite direction, by -{name}",
    np.negative,
)

# One entry for another, as an index or a loop does it.
LEFT_OUT = Change(
    "joints-left-out",
    "your code does not rotate any joint, so the result is always the pose at "
    "`{name}` = 0",
    np.zeros_like,
)
FIRST_FOR_ALL = Change(
    "first-angle-for-all",
    "your code uses `{name}[0]` for every joint, but each joint has its own entry in "
    "`{name}`",
    lambda x: np.repeat(x[:1], len(x), axis=0),
)
ONE_OFF = Change(
    "off-by-one-joint",
    "your index into `{name}` is off by one, so each joint after the first uses "
    "the entry of the previous joint",
    partial(np.roll, shift=1),
)
OF_ALL_JOINTS = (
    LEFT_OUT,
    BACKWARDS,
    RADIANS_TWICE,
    DEGREES,
    Change(
        "last-joint-missing",
        "your code does not move the last joint. Does your loop leave out this joint?",
        partial(_only, slice(-1)),
    ),
    Change(
        "first-joint-missing",
        "your code does not move the first joint. Does your loop leave out this joint?",
        partial(_only, slice(1, None)),
    ),
    Change(
        "first-joint-only",
        "your code moves only the first joint. Is `return` inside the loop?",
        partial(_only, slice(1)),
    ),
    Change(
        "last-joint-only",
        "your code moves only the last joint. Does your loop overwrite the motion of "
        "the other joints?",
        partial(_only, slice(-1, None)),
    ),
    ONE_OFF,
)

# Order within it.
HALVES_SWAPPED = Change(
    "halves-swapped",
    "your code swaps the two halves of `{name}`. The angular half comes first",
    partial(np.roll, shift=3, axis=0),
)

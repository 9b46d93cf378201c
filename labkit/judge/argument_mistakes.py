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

    redone: str = "the correct result with that {name}"
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
    "{name} is converted to degrees; sine and cosine take radians",
    np.rad2deg,
)
RADIANS_TWICE = Change(
    "radians-taken-for-degrees",
    "{name} is converted from degrees, but {name} is already in radians",
    np.deg2rad,
)
INTO_COS = DEGREES.called("degrees-into-cos")
OF_AN_ANGLE = (
    INTO_COS,
    RADIANS_TWICE,
    Change(
        "half-angle",
        "the rotation is by half of {name}, as in a quaternion",
        lambda x: x / 2,
    ),
    Change(
        "double-angle",
        "the rotation is by twice {name}; only a quaternion has half angles",
        lambda x: 2 * x,
    ),
)

# Signs.
NEGATED = Change("{name}-sign", "`{name}` enters with the wrong sign", np.negative)
BACKWARDS = Change(
    "all-backwards",
    "every joint rotates in the opposite sense, by -{name}",
    np.negative,
)

# One entry for another, as an index or a loop does it.
LEFT_OUT = Change(
    "joints-left-out",
    "no joint moves: the result for every {name} is the pose at {name} = 0",
    np.zeros_like,
    "the pose at {name} = 0",
)
FIRST_FOR_ALL = Change(
    "first-angle-for-all",
    "every joint uses {name}[0]; each has its own entry",
    lambda x: np.repeat(x[:1], len(x), axis=0),
    "the correct result with {name}[0] everywhere",
)
ONE_OFF = Change(
    "off-by-one-joint",
    "every joint uses its neighbour's entry: the index into {name} is off by one",
    partial(np.roll, shift=1),
)
OF_ALL_JOINTS = (
    LEFT_OUT,
    BACKWARDS,
    RADIANS_TWICE,
    DEGREES,
    Change(
        "last-joint-missing",
        "the last joint has no effect, as if the loop ended one joint early",
        partial(_only, slice(-1)),
    ),
    Change(
        "first-joint-missing",
        "the first joint has no effect, as if the loop started one joint late",
        partial(_only, slice(1, None)),
    ),
    Change(
        "first-joint-only",
        "only the first joint has an effect, as if return were inside the loop",
        partial(_only, slice(1)),
    ),
    Change(
        "last-joint-only",
        "only the last joint has an effect, as if the loop overwrote the others",
        partial(_only, slice(-1, None)),
    ),
    ONE_OFF,
)

# Order within it.
HALVES_SWAPPED = Change(
    "halves-swapped",
    "the halves of {name} are swapped; the angular half comes first",
    partial(np.roll, shift=3, axis=0),
)

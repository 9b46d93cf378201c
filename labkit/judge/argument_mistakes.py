"""Mistakes made with one argument before it is used, whatever function takes it.

A day's file picks those that make a difference and may say them in words of its own:

    row.of_argument("q", DEGREES, replace(REVERSED, slug="from-the-tip"))
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Change:
    """A mistake with one argument."""

    slug: str  # its name
    says: str  # as in a `Mistake`; {name} is the argument's
    change: Callable[[Any], Any]  # from the argument to what is used in its place
    redone: str  # as in a `Mistake`; {name} is the argument's
    hidden: str = ""  # why the lab cannot show it, "" where it can


DEGREES = Change(
    "degrees",
    "{name} is taken for degrees; it is in radians",
    np.deg2rad,
    "the right one with {name} taken for degrees",
)
RADIANS_TWICE = Change(
    "radians-twice",
    "{name} is converted from radians to degrees; it must stay in radians",
    np.rad2deg,
    "the right one with {name} in degrees",
)
TRANSPOSED = Change(
    "transposed",
    "{name} is transposed",
    np.transpose,
    "the right one with {name} transposed",
)
REVERSED = Change(
    "reversed",
    "{name} is taken from its end to its beginning",
    lambda x: x[::-1],
    "the right one with {name} reversed",
)
NEGATED = Change(
    "negated",
    "{name} enters with the wrong sign",
    np.negative,
    "the right one with -{name}",
)

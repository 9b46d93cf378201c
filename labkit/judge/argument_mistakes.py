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
    """A mistake with one argument.

    Attributes:
        slug: its name.
        says: as in a `Mistake`; {name} is the argument's.
        change: from the argument to what is used in its place.
        redone: as in a `Mistake`; {name} is the argument's.
        hidden: why the lab cannot show it, "" where it can.
    """

    slug: str
    says: str
    change: Callable[[Any], Any]
    redone: str
    hidden: str = ""


def _halves_swapped(x: np.ndarray) -> np.ndarray:
    return np.concatenate([x[3:], x[:3]])


def _first_only(x: np.ndarray) -> np.ndarray:
    return np.full_like(x, x[0])


def _last_missing(x: np.ndarray) -> np.ndarray:
    return np.concatenate([x[:-1], np.zeros_like(x[-1:])])


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
HALVES_SWAPPED = Change(
    "halves-swapped",
    "the halves of {name} are swapped: the angular three come first",
    _halves_swapped,
    "the right one with the halves of {name} swapped",
)
FIRST_ONLY = Change(
    "first-only",
    "only the first number of {name} is used, for all of them",
    _first_only,
    "the right one with {name}[0] for all",
)
LAST_MISSING = Change(
    "last-missing",
    "the last one of {name} is left out",
    _last_missing,
    "the right one without the last of {name}",
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

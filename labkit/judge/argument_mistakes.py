"""Mistakes made with one argument before it is used, whatever function takes it.

A day's file picks those that make a difference, or gives them a name of its own:

    row.of_argument("q", DEGREES, REVERSED.called("joints-in-reverse"))
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from labkit.judge.mistake import Mistake


@dataclass(frozen=True)
class Change(Mistake):
    """A mistake with one argument, which `redo` takes; {name} in its texts is its."""

    redone: str = "the right one with that {name}"
    hidden: str = ""  # why the lab cannot show it, "" where it can

    def called(self, slug: str) -> "Change":
        """Return the same mistake under another name."""
        return replace(self, slug=slug)


def _only(some: slice, x: Any) -> Any:
    """Return x with some entries kept and 0 for the others."""
    kept = np.zeros_like(x)
    kept[some] = x[some]
    return kept


def _rounded(x: Any, decimals: int) -> Any:
    """Round as Python does: it and NumPy differ at a tie, such as 0.785."""
    return np.vectorize(lambda one: round(float(one), decimals), [float])(x)[()]


# Angles.
DEGREES = Change(
    "degrees",
    "{name} is converted to degrees; sine and cosine take radians, as it comes",
    np.rad2deg,
)
RADIANS_TWICE = Change(
    "radians-taken-for-degrees",
    "{name} is in radians already, and is converted from degrees once more",
    np.deg2rad,
)
INTO_COS = DEGREES.called("degrees-into-cos")
OF_AN_ANGLE = (
    INTO_COS,
    RADIANS_TWICE,
    Change(
        "half-angle",
        "it turns by half of {name}: that belongs to quaternions",
        lambda x: x / 2,
    ),
    Change(
        "double-angle",
        "it turns by twice {name}; in a quaternion stand sine and cosine of half of it",
        lambda x: 2 * x,
    ),
)
ROUNDED = tuple(
    Change(
        "angle-rounded",
        f"{{name}} is rounded to {decimals} decimals before it is used",
        partial(how, decimals=decimals),
    )
    for decimals in range(4)
    for how in (np.round, _rounded)
)
SMALL_LEFT_OUT = tuple(  # any bound between two angles that are asked does it
    Change(
        "small-angle-ignored",
        "a small {name} is taken for 0; the formula is exact for small ones too, and "
        "needs no case of its own",
        lambda x, small=small: x * (abs(x) >= small),
        hidden="the lab draws hardly any angle so small",
    )
    for small in (1e-3, 1e-2)
)

# Signs.
NEGATED = Change("{name}-sign", "{name} enters with the wrong sign", np.negative)
BACKWARDS = Change(
    "all-backwards", "every joint turns the other way, by -{name}", np.negative
)
SIGN_LOST = Change(
    "sign-of-{name}-lost",
    "the sign of {name} is lost: what is negative counts as positive",
    np.abs,
)

# One entry for another, as an index or a loop does it.
LEFT_OUT = Change(
    "joints-left-out",
    "no joint turns: whatever {name} is, your pose is the one at {name} = 0",
    np.zeros_like,
    "the pose at {name} = 0",
)
FIRST_FOR_ALL = Change(
    "first-angle-for-all",
    "every joint is given the first, {name}[0]; each has its own",
    lambda x: np.repeat(x[:1], len(x), axis=0),
    "the right one with {name}[0] everywhere",
)
REVERSED = Change(
    "{name}-backwards", "{name} is read backwards: joint1 gets the last", np.flipud
)
ONE_OFF = tuple(
    Change(
        "off-by-one-joint",
        "each joint is given its neighbour's: {name} is indexed one off",
        shifted,
    )
    for shifted in (
        partial(np.roll, shift=1),
        partial(np.roll, shift=-1),
        lambda x: np.append(0.0, x[:-1]),
        lambda x: np.append(x[1:], 0.0),
    )
)
OF_ALL_JOINTS = (
    LEFT_OUT,
    BACKWARDS,
    SIGN_LOST,
    RADIANS_TWICE,
    DEGREES,
    FIRST_FOR_ALL,
    REVERSED,
    Change(
        "last-joint-missing",
        "the last joint does not count: the loop ends one too early",
        partial(_only, slice(-1)),
    ),
    Change(
        "first-joint-missing",
        "the first joint does not count: the loop starts one too late",
        partial(_only, slice(1, None)),
    ),
    Change(
        "first-joint-only",
        "only the first joint counts (does return stand inside the loop?)",
        partial(_only, slice(1)),
    ),
    Change(
        "last-joint-only",
        "only the last joint counts: what the others do is overwritten",
        partial(_only, slice(-1, None)),
    ),
    *ONE_OFF,
)

# Order within it.
HALVES_SWAPPED = Change(
    "halves-swapped",
    "the halves of {name} are swapped: the angular three come first",
    partial(np.roll, shift=3, axis=0),
)
TRANSPOSED = Change(
    "transposed",
    "{name} is transposed, or multiplied from the wrong side",
    lambda x: np.swapaxes(x, -1, -2),
)

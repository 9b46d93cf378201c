"""Which mistakes can be hunted, and which one a seed draws."""

import hashlib
from collections.abc import Callable, Collection
from typing import Any, NamedTuple

from labkit.judge.row import rows_of
from labkit.lesson.day import Day, days_of
from robo47.errors import Robo47Error

LEVELS = {
    1: "one function of the day is wrong",
    2: "one function of the week is wrong; all that you see is its capstone",
    3: "two functions of the day are wrong",
}


class Quarry(NamedTuple):
    """A mistake in a function."""

    day: int  # that teaches the function
    function: str
    slug: str  # the mistake's name
    says: str  # what the checker says of it
    code: Callable[..., Any]  # the function with the mistake in it


def quarries(day: Day) -> list[Quarry]:
    """Return the mistakes of a day's functions that show when its lab is run."""
    return [
        Quarry(day.number, function, way.slug, way.says, way.code)
        for function, row in rows_of(day).items()
        for way in row.ways
        if way.status == "wrong" and not way.hidden and not way.reached
    ]


def drawn(day: Day, level: int, seed: int, known: Collection[str] = ()) -> list[Quarry]:
    """Return what is to be found, by a seed.

    Args:
        day: whose functions; at level 2 with those of its week before it.
        level: one of `LEVELS`.
        seed: the same seed gives the same mistake, with the same kit.
        known: names of mistakes that are not drawn: somebody's own.

    Raises:
        Robo47Error: nothing is left to be drawn.
    """
    pool = quarries(day) if level != 2 else of_the_capstone(day)
    pool = [one for one in pool if one.slug not in known]
    if not pool:
        raise Robo47Error(f"day {day.number} has no mistake that you have not met")
    found = [pool[_number(day, level, seed) % len(pool)]]
    if level == 3:
        others = [one for one in pool if one.function != found[0].function]
        found += [others[_number(day, 4, seed) % len(others)]] if others else []
    return found


def of_the_capstone(day: Day) -> list[Quarry]:
    """Return mistakes of the functions that the capstone of a day's week calls.

    Raises:
        Robo47Error: that week has no capstone.
    """
    from labkit.check.own_functions import capstone_of

    uses = capstone_of(day.week).USES
    found = []
    for other in days_of(day.week):
        if other.number <= day.number:
            asked = uses.get(other.number, ())
            found += [one for one in quarries(other) if one.function in asked]
    return found


def _number(day: Day, level: int, seed: int) -> int:
    drawn = hashlib.sha256(f"{day.number} {level} {seed}".encode()).digest()
    return int.from_bytes(drawn[:8], "big")

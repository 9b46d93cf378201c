"""The pool of mistakes that can be hunted, and the sample of a seed."""

import hashlib
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple

from labkit.hunt.capstone_list import visible_mistakes
from labkit.judge.row import rows_of
from labkit.lesson.day import Day, days_of
from robo47.errors import Robo47Error

LEVELS = {
    1: "one function of the day is wrong",
    2: "one function of the week is wrong, and you see only the capstone",
    3: "two functions of the day are wrong",
}


class HiddenMistake(NamedTuple):
    """A mistake in a function, which a student is to find."""

    day: int  # the day that teaches the function
    function: str
    slug: str  # the mistake's name
    says: str  # the checker's sentence about it
    code: Callable[..., Any]  # the function with the mistake in it


def mistakes_of(day: Day) -> list[HiddenMistake]:
    """Return the mistakes of a day's functions that a run of its lab shows."""
    return [
        HiddenMistake(day.number, function, way.slug, way.says, way.code)
        for function, row in rows_of(day).items()
        for way in row.ways
        if way.status == "wrong" and not way.hidden and not way.reached
    ]


def pool_of(day: Day, level: int) -> list[HiddenMistake]:
    """Return the pool of a day at a level.

    Raises:
        Robo47Error: the pool is empty, because this kit has no such catalogue or no
            capstone shows any mistake.
    """
    found = mistakes_of(day) if level != 2 else visible_in_capstone(day)
    if not found:
        what = f"mistakes of day {day.number}"
        what += " that the capstone shows" if level == 2 else ""
        raise Robo47Error(f"there is nothing to hunt: this kit has no {what}")
    return found


def sample(
    day: Day, level: int, seed: int, known: Collection[str] = ()
) -> list[HiddenMistake]:
    """Return the mistakes of a hunt, sampled from the pool by a seed.

    Each function, and then each of its mistakes, gets a hash, and the lowest is taken.
    A mistake that a newer kit adds therefore changes few hunts of older seeds.

    Args:
        day: whose functions; at level 2 with those of its week before it.
        level: one of `LEVELS`.
        seed: the same seed gives the same mistake, with the same kit.
        known: names of mistakes that the student has met, which are left out.

    Raises:
        Robo47Error: the student has met all of them.
    """
    pool = [one for one in pool_of(day, level) if one.slug not in known]
    if not pool:
        raise Robo47Error(f"day {day.number} has no mistake that you have not met")

    def number(*words: str) -> bytes:
        text = " ".join([str(day.number), str(level), str(seed), *words])
        return hashlib.sha256(text.encode()).digest()

    functions = sorted({one.function for one in pool}, key=number)
    return [
        min(
            (one for one in pool if one.function == function),
            key=lambda one: number(one.function, one.slug),
        )
        for function in functions[: 2 if level == 3 else 1]
    ]


def mark_of(one: HiddenMistake, level: int, seed: int) -> str:
    """Return a hash that identifies a mistake in another kit and does not reveal it."""
    text = f"{level} {seed} {one.day} {one.function} {one.slug}"
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def marked(
    day: Day, level: int, seed: int, marks: Sequence[str]
) -> list[HiddenMistake]:
    """Return the mistakes with these marks of `mark_of`.

    Raises:
        Robo47Error: this kit lacks one of them.
    """
    pool = {mark_of(one, level, seed): one for one in reversed(pool_of(day, level))}
    if any(mark not in pool for mark in marks):
        raise Robo47Error(
            f"this kit's day {day.number} has no longer the mistake of this hunt."
            f" Begin another: make hunt DAY={day.number} ARGS=--anew"
        )
    return [pool[mark] for mark in marks]


def visible_in_capstone(day: Day) -> list[HiddenMistake]:
    """Return mistakes of days up to this one that the capstone of its week shows.

    Raises:
        Robo47Error: that week has no capstone.
    """
    shown = visible_mistakes(day.week)
    return [one for one in called_by_capstone(day) if (one.function, one.slug) in shown]


def called_by_capstone(day: Day) -> list[HiddenMistake]:
    """Return mistakes of days up to this one in functions that the capstone calls.

    Raises:
        Robo47Error: the day's week has no capstone.
    """
    from labkit.check.own_functions import capstone_of

    uses = capstone_of(day.week).USES
    found = []
    for other in days_of(day.week):
        if other.number <= day.number:
            asked = uses.get(other.number, ())
            found += [one for one in mistakes_of(other) if one.function in asked]
    return found

"""A student's lab on a newer kit: theirs is kept, the kit's lines around it are new."""

import re
from collections import Counter
from collections.abc import Iterable

from labkit.lesson.day import Day
from labkit.lesson.merge import conflicts, keep_ours, merged
from labkit.lesson.script import function_lines, make_starter, put_back
from robo47.errors import Robo47Error


def renewed(day: Day, text: str, before: Iterable[str], now: str) -> str:
    """Return a student's lab with what is new in the kit's.

    Functions, helpers and constants of theirs stay; where both changed the same line it
    is theirs, but for `main`, which is the kit's recipe.

    Args:
        day: from the newer kit's manifest.
        text: the student's lab.
        before: the kit's complete labs of earlier versions; the one that is most like
            the student's is the one they began with.
        now: the kit's complete lab of the newer version.
    """
    starters = [_called_as_now(day, one) for one in _starters(day, before)]
    text, starter = _called_as_now(day, text), make_starter(now, day.script, day.number)
    if not starters:
        return text
    base = min(starters, key=lambda one: _apart(one, text))
    if conflicts(base, text, starter) and function_lines(base, "main")[0] >= 0:
        text = put_back(text, base, ("main",))
    return merged(base, text, starter, keep_ours)


def _starters(day: Day, before: Iterable[str]) -> list[str]:
    found = []
    for text in dict.fromkeys(before):
        try:
            found.append(make_starter(text, day.script, day.number))
        except Robo47Error:  # no lab with regions yet
            continue
    return found


def _called_as_now(day: Day, text: str) -> str:
    """Return a text with functions that have another name now."""
    for task in day.tasks:
        for old, new in task.renamed:
            text = re.sub(rf"(?<![.\w]){old}(?=\s*[(,)])", new, text)
    return text


def _apart(starter: str, text: str) -> tuple[int, int]:
    """Return how many lines of a starter a lab has not, and how many it has besides."""
    lines, own = (Counter(t.split("\n")) - Counter({"": 1000}) for t in (starter, text))
    return (lines - own).total(), (own - lines).total()

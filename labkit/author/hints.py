"""Hints: of a size to read, with a question, and without the solution's formula."""

import re
from collections.abc import Iterator

from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import find_regions
from robo47.paths import shown

HOW_MANY = (2, 3)  # hints of a task
WORDS = (20, 50)  # the limits of a hint
GIVEN_AWAY = (
    7  # tokens of the solution in a row, with an operator or a bracket: a formula
)


def faults_of(day: Day) -> Iterator[str]:
    """Yield what is wrong with a day's hints, each with what to do."""
    file = shown(day.own / "day.toml")
    solution = solutions(day)
    for task in day.tasks:
        where = f"{file}, task {task.id}: "
        if not HOW_MANY[0] <= len(task.hints) <= HOW_MANY[1]:
            yield f"{where}it has {len(task.hints)} hints; write 2 or 3"
        if not any("?" in hint for hint in task.hints):
            yield f"{where}no hint asks anything; end one with a question"
        for i, hint in enumerate(task.hints, 1):
            words = len(hint.split())
            if not WORDS[0] <= words <= WORDS[1]:
                yield (
                    f"{where}hint {i} has {words} words; a hint has {WORDS[0]} to "
                    f"{WORDS[1]}"
                )
            if given := given_away(hint, solution):
                yield (
                    f"{where}hint {i} has the solution's own `{given}`; ask for what "
                    "leads there instead"
                )


def solutions(day: Day) -> list[list[str]]:
    """Return the tokens of each region of the complete lab."""
    text = read_script(day.source)
    lines = text.splitlines()
    regions = find_regions(text, shown(day.source))
    return [tokens("\n".join(lines[r.start + 1 : r.end])) for r in regions]


def tokens(text: str) -> list[str]:
    """Return the tokens of code, or of words as if they were code."""
    return re.findall(r"\w+|[^\w\s]", re.sub(r"#.*", "", text))


def given_away(hint: str, solution: list[list[str]]) -> str:
    """Return the part of the solution that a hint has, "" where it has none.

    Args:
        hint: its text.
        solution: tokens of each region.
    """
    said = tokens(hint)
    best: list[str] = []
    for region in solution:
        for i in range(len(said)):
            for j in range(len(region)):
                n = 0
                while said[i + n : i + n + 1] == region[j + n : j + n + 1] != []:
                    n += 1
                best = max(best, said[i : i + n], key=len)
    operators = sum(one in "+-*/@=([" for one in best)
    return " ".join(best) if len(best) >= GIVEN_AWAY and operators else ""

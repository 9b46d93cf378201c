"""The numbers of the student's retrospective, between two marks of its file.

`<!-- numbers -->` and `<!-- end -->` stand in the files that week.toml names. What is
between them is written anew; every other byte is the student's and stays as it is.
"""

from collections.abc import Sequence
from pathlib import Path

from labkit.base import store
from labkit.base.text import blocks, number_of, refill
from labkit.lesson.student_files import retrospectives
from labkit.report.week_facts import OwnDay
from robo47.errors import Robo47Error
from robo47.paths import shown

_MARKS = {  # a note that follows a number
    "pass": "",
    "none": "",
    "kit": "",
    "fail": " (not yet)",
    "stale": " (my file changed since)",
    "borrowed": " (partly borrowed)",
}


def fill(facts: Sequence[OwnDay]) -> list[Path]:
    """Write a week's numbers into its retrospectives; return those that have changed.

    Args:
        facts: of the week's days.

    Raises:
        Robo47Error: a file cannot be written.
    """
    if not any(one.day.work.is_file() for one in facts):
        return []  # nobody's numbers
    text = as_markdown(facts)
    changed = []
    for path in retrospectives(facts[0].day.week):
        try:
            before = path.read_bytes().decode("utf-8", "surrogateescape")
            if len(blocks(before, "numbers")) != 1:
                continue  # no marks, or somebody wrote about them: not ours
            after = refill(before, {"numbers": lambda *_: text})
            if after != before:
                store.replace(path, after.encode("utf-8", "surrogateescape"))
                changed.append(path)
        except OSError as error:
            raise Robo47Error(
                f"{shown(path)} cannot be written: {error.strerror or error}"
            ) from None
    return changed


def as_markdown(facts: Sequence[OwnDay]) -> str:
    """Return a week's numbers as a table and three lines."""
    rows = [
        "| day | number | mine | worst on the way | limit |",
        "|---|---|---|---|---|",
    ]
    for one in facts:
        for number in one.numbers:
            name = one.day.name_of(number.wanted)
            limit = number.wanted.limit
            latest, worst = (
                "no row yet" if value is None else number_of(value)
                for value in (number.latest, number.worst)
            )
            mine = latest + _MARKS[number.status]
            rows.append(f"| {one.day.number} | {name} | {mine} | {worst} | {limit} |")
    met = [m for one in facts for m in one.met]
    left = sum(m.now == "left behind" for m in met)
    graded = [passed for one in facts for passed in one.graded]
    own = sum(len(one.own) for one in facts)
    of = sum(one.functions for one in facts)
    says = [
        f"Tasks passed: {sum(graded)} of {len(graded)}."
        f" Functions of my own: {own} of {of}."
    ]
    if tasks := ", ".join(task for one in facts for task in one.borrowed):
        says.append(f"Borrowed from the kit, and not counted: {tasks}.")
    if days := ", ".join(str(one.day.number) for one in facts if not one.checked):
        since = "Not counted, since `make check` has not seen it as it is"
        says.append(f"{since}: day {days}.")
    says.append(f"Named mistakes met: {len(met)}; left behind: {left}.")
    return "\n".join(["", *rows, "", *says, "", ""])


def no_numbers(text: str) -> bool:
    """Return whether a retrospective's numbers are still to be filled in."""
    found = blocks(text, "numbers")
    return len(found) == 1 and not found[0].strip()


def without_numbers(text: str) -> str:
    """Return a retrospective as the student wrote it, without what is filled in."""
    return refill(text, {"numbers": lambda *_: ""})

"""The places of a worksheet that wait for words, read and filled in.

A place is a line such as `*(your words)*`; its name is the heading above it, or, in a
numbered list, "question" and its number. The table of predictions has its own module.
"""

import re
from dataclasses import dataclass

from labkit.lesson.predictions import rows_asked
from robo47.errors import Robo47Error

_OPEN = re.compile(r"^(?P<indent> *)\*\((?P<asks>your [^)]*)\)\*\s*$")
_HEADING = re.compile(r"^#+ (.+)$")
_QUESTION = re.compile(r"^(\d+)\. (.*)$")


@dataclass(frozen=True)
class Place:
    """One place of a worksheet that is open."""

    name: str  # "Axis or surface", "question 1"
    asks: str  # the text between the heading and the place
    indent: str  # white space in front of each line
    line: int  # index of its line


def places(worksheet: str) -> list[Place]:
    """Return the open places of a worksheet, in order; drawings are left out."""
    found: list[Place] = []
    name, asks = "", list[str]()
    for i, line in enumerate(worksheet.splitlines()):
        heading, question = _HEADING.match(line), _QUESTION.match(line)
        if heading:
            name, asks = heading[1].strip(), []
        elif question:
            name, asks = f"question {question[1]}", [question[2]]
        elif place := _OPEN.match(line):
            if "drawing" not in place["asks"]:
                words = "\n".join(asks).strip()
                found.append(Place(name, words, place["indent"], i))
        elif not line.startswith("|"):
            asks.append(line.strip())
    return found


def with_answer(worksheet: str, name: str, answer: str, before: str = "") -> str:
    """Return a worksheet with an answer in its place.

    Args:
        worksheet: its text.
        name: of the place.
        answer: Markdown.
        before: the answer that was written there last, "" if none was.

    Raises:
        Robo47Error: the worksheet has no such place, or other words stand there.
    """
    lines = worksheet.splitlines()
    for place in places(worksheet):
        if place.name == name:
            lines[place.line : place.line + 1] = _lines(answer, place.indent)
            return "\n".join(lines) + "\n"
    for indent in ("   ", ""):
        old = "\n".join(_lines(before, indent))
        if before and worksheet.count(old) == 1:
            return worksheet.replace(old, "\n".join(_lines(answer, indent)))
    if name in _names(worksheet):
        raise Robo47Error(
            f"{name!r} has another answer already; edit the worksheet itself"
        )
    still = ", ".join(repr(place.name) for place in places(worksheet)) or "none"
    raise Robo47Error(f"the worksheet has no place {name!r}; still open: {still}")


def _names(worksheet: str) -> set[str]:
    """Return the names of all places that a worksheet may have, open or not."""
    lines = worksheet.splitlines()
    headings = {found[1].strip() for line in lines if (found := _HEADING.match(line))}
    numbers = {found[1] for line in lines if (found := _QUESTION.match(line))}
    return headings | {f"question {number}" for number in numbers}


def with_prediction(worksheet: str, number: str, value: str) -> str:
    """Return a worksheet with a prediction in its row.

    Args:
        worksheet: its text.
        number: the first cell of the row.
        value: the second one.

    Raises:
        Robo47Error: the table has no such row.
    """
    lines = worksheet.splitlines()
    for i, line in enumerate(lines):
        cells = line.split("|")
        if len(cells) == 6 and cells[1].strip().replace("`", "") == number:
            cells[2] = f" {value} "
            lines[i] = "|".join(cells)
            return "\n".join(lines) + "\n"
    rows = ", ".join(map(repr, rows_asked(worksheet)))
    raise Robo47Error(
        f"the worksheet has no row {number!r} in its table Predictions; it has {rows}"
    )


def _lines(answer: str, indent: str) -> list[str]:
    return [f"{indent}{line}".rstrip() for line in answer.strip().splitlines()]

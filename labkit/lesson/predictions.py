"""The worksheet's table of predictions, with the predicted and measured values.

A row is `| number | predicted | measured | why apart |`. The first two cells and the
last are the student's; `make run` writes the third, where nobody else has.
"""

import math
import re
from collections.abc import Mapping

_OPEN = re.compile(r"\*\([^*]*\)\*|[._\s…-]*")  # the template's own words, or none
_HEAD = re.compile(r"number|what is wrong|[-: ]*")  # the head of the table
_OURS = re.compile(r"(-?[\d.]+(?:e[-+]\d+)?) \(run of \d\d:\d\d\)")


def rows_asked(worksheet: str) -> dict[str, str]:
    """Return {number: what its second cell holds, "" where it is open}."""
    asked = {}
    for row in filter(None, map(_cells, worksheet.splitlines())):
        text = row[2].strip()
        asked[_name(row)] = "" if _OPEN.fullmatch(text) else text
    return {name: asked[name] for name in asked if not _HEAD.fullmatch(name)}


def predictions(worksheet: str) -> dict[str, str]:
    """Return {number: predicted} of the rows that have a prediction."""
    return {name: text for name, text in rows_asked(worksheet).items() if text}


def with_measured(worksheet: str, measured: Mapping[str, float], when: str) -> str:
    """Return a worksheet with the numbers of a run in it.

    A number goes where there is a prediction, and its cell is open or holds what a run
    wrote; there it changes only where the number does. All else stays, byte by byte.

    Args:
        worksheet: its text.
        measured: the value of each number, by the first cell of its row.
        when: the run's hour, "14:05".
    """
    finite = {name: value for name, value in measured.items() if math.isfinite(value)}
    wanted = {name: f"{value:z.4g}" for name, value in finite.items()}
    has = predictions(worksheet)
    lines = worksheet.splitlines(keepends=True)
    for i, line in enumerate(lines):
        row = _cells(line)
        name = _name(row) if row else ""
        if name not in has or name not in wanted:
            continue
        before = row[3].strip()
        ours = _OURS.fullmatch(before)
        if ours[1] != wanted[name] if ours else _OPEN.fullmatch(before):
            row[3] = f" {wanted[name]} (run of {when}) "
            lines[i] = "|".join(row)
    return "".join(lines)


def _cells(line: str) -> list[str]:
    """Return a line's six pieces around its bars; [] where it is no row of four."""
    pieces = line.split("|")
    return pieces if len(pieces) == 6 and not pieces[0].strip() else []


def _name(row: list[str]) -> str:
    return row[1].strip().replace("`", "")

"""A clone's numbers beside the committed ones.

A number at the level of rounding differs between two processors, and should: it must
be within its limit again. A physical one must be the same within a factor of two.
"""

from pathlib import Path

from labkit.base.text import number_of
from labkit.handin.handin import read_handin
from labkit.handin.rows import own_rows
from labkit.log.rows import Row
from labkit.report.series import Series, value_of
from labkit.report.week_labs import LabResult
from robo47.errors import Robo47Error

ROUNDING = 1e-9
FACTOR = 2.0


def faults(ran: LabResult, clone: Path) -> list[str]:
    """Return what is not as it was committed, a line each.

    Args:
        ran: what became of a day's lab in the clone.
        clone: its folder.
    """
    day = ran.day
    if ran.why:
        return [f"day {day.number}, the lab does not pass: {ran.why}"]
    try:
        rows = own_rows(day, read_handin(day, clone)) if ran.mine else {}
    except Robo47Error as error:
        return [f"day {day.number}: {error}"]
    found = []
    for number in ran.numbers:
        row = rows.get((number.wanted.check, number.wanted.metric))
        if why := _fault(number, row, mine=ran.mine):
            found.append(f"day {day.number}, {day.name_of(number.wanted)}: {why}")
    return found


def _fault(number: Series, row: Row | None, *, mine: bool) -> str:
    value = number.latest
    if value is None:
        return "the lab recorded no such number"
    if number.status != "pass":
        return f"{number_of(value)} in the clone; it must be {number.wanted.limit}"
    if not mine:
        return ""  # the kit's own: nobody committed a row
    before = value_of(row) if row else None
    if before is None:
        return "no committed row of this file; make run, then commit the log"
    if same(before, value):
        return ""
    return f"{number_of(value)} in the clone, {number_of(before)} in the committed log"


def same(before: float, now: float) -> bool:
    """Return whether a number within its limit is the committed one."""
    if abs(before) < ROUNDING:
        return True
    return 1 / FACTOR <= now / before <= FACTOR

"""What a day hands in beside its code. Read here, never edited.

    figure      the student's picture
    worksheet   definitions, drawings, checklist
    rows        the numbers in the metrics log
    commit      all of it in git

Each returns an `Item`: how it stands, and what to do about it.
"""

from pathlib import Path

from robo47.checker.deliverables.commit import check_commit
from robo47.checker.deliverables.figure import check_figure
from robo47.checker.deliverables.item import Item
from robo47.checker.deliverables.rows import check_rows
from robo47.checker.deliverables.worksheet import check_worksheet
from robo47.lesson.day import Day
from robo47.paths import ROOT

__all__ = ["Item", "check_deliverables"]


def check_deliverables(
    day: Day, root: Path = ROOT, *, tasks_pass: bool = True
) -> list[Item]:
    """Check what a day hands in.

    Args:
        day: from the kit's manifest.
        root: the student's clone.
        tasks_pass: whether the day's tasks do; until then no row is the student's.

    Returns:
        One item per deliverable.
    """
    week = root / day.folder.name
    return [
        check_figure(day, week),
        *check_worksheet(day, week),
        check_rows(day, root, tasks_pass),
        check_commit(day, root),
    ]

"""A day's deliverables beside its code. Read here, never edited.

    handin      which files, read without trusting the folder
    figure      the student's picture
    worksheet   definitions, drawings, checklist
    rows        the numbers in the metrics log
    commit      all of it in git; `git` asks

Each check returns an `Item`: how it stands, and what to do about it.
"""

from pathlib import Path

from labkit.base.git import GitError, read_history
from labkit.handin.commit import check_commit, wanted_names
from labkit.handin.handin import Handin, read_handin
from labkit.handin.item import Item
from labkit.handin.rows import check_rows
from labkit.handin.worksheet import check_worksheet
from labkit.lesson.day import Day
from robo47.errors import FaultError
from robo47.paths import ROOT, shown

__all__ = ["Item", "check_deliverables", "check_files", "item_names"]


def item_names(day: Day) -> list[str]:
    """Return the names of a day's deliverables, in the order of the checks."""
    names = ["figure"] if day.figure else []
    if day.worksheet:
        names += ["definitions"] if day.terms or day.questions else []
        names += ["drawings"] if day.drawings else []
        names += ["checklist"]
    return [*names, *(["metrics"] if day.metrics else []), "commit"]


def check_deliverables(
    day: Day, root: Path = ROOT, *, tasks_pass: bool = True
) -> list[Item]:
    """Check what a day hands in.

    Args:
        day: from the kit's manifest.
        root: the student's clone.
        tasks_pass: whether the day's tasks do; until then no row counts.

    Returns:
        One item per deliverable that the day has.

    Raises:
        FaultError: the machine does not let it be read now.
    """
    try:
        handin = read_handin(day, root)
    except OSError as error:
        where = shown(Path(error.filename)) if error.filename else "your work"
        why = f"{where} cannot be read: {error.strerror}"
        raise FaultError(f"{why}. Nothing was judged: try again") from None
    try:
        history = read_history(root, wanted_names(day, handin), own=True)
        commit = check_commit(day, handin, history)
    except GitError as error:
        commit = Item("commit", "todo", f"Nobody can tell: {error}.")
    return [*check_files(day, handin, tasks_pass=tasks_pass), commit]


def check_files(day: Day, handin: Handin, *, tasks_pass: bool = True) -> list[Item]:
    """Check what a day hands in, but for the commit.

    Args:
        day: from the kit's manifest.
        handin: what the student's folder holds.
        tasks_pass: whether the day's tasks do; until then no row counts.
    """
    from labkit.handin.figure import check_figure  # it brings MuJoCo

    checks = {
        "figure": (["figure"], lambda: [check_figure(day, handin)]),
        "worksheet": (
            ["definitions", "drawings", "checklist"],
            lambda: check_worksheet(day, handin),
        ),
        "log": (["metrics"], lambda: [check_rows(day, handin, tasks_pass=tasks_pass)]),
    }
    found: dict[str, Item] = {}
    for what, (names, check) in checks.items():
        file = day.files.get(what, "")
        if file in handin.unread:
            says = f"{file} {handin.unread[file]}."
            found |= {name: Item(name, "wrong", says) for name in names}
        elif file:
            found |= {item.name: item for item in check()}
    return [found[name] for name in item_names(day) if name in found]

"""A day's deliverables, each checked in order: figure, worksheet, numbers, commit."""

from dataclasses import replace
from pathlib import Path

from labkit.base.git import GitError, History, ignored_by, read_history
from labkit.base.text import visible
from labkit.handin.handin import Handin, Item, read_handin
from labkit.handin.rows import check_rows
from labkit.handin.worksheet import check_worksheet
from labkit.lesson.day import Day
from robo47.errors import FaultError
from robo47.paths import ROOT, shown

_ITEMS = {  # each check of a deliverable, in the order of checking
    "figure": ["figure"],
    "worksheet": ["definitions", "drawings"],
    "log": ["metrics"],
}


def item_names(day: Day) -> list[str]:
    """Return the names of a day's deliverables, in the order of the checks."""
    asked = {"definitions": day.terms or day.questions, "drawings": day.drawings}
    there = [name for what in _ITEMS if what in day.files for name in _ITEMS[what]]
    return [*(name for name in there if asked.get(name, True)), "commit"]


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
        commit = _with_ignored(commit, root, [*handin.files], history)
    except GitError as error:
        commit = Item("commit", "todo", f"The commit could not be checked: {error}.")
    return [*check_files(day, handin, tasks_pass=tasks_pass), commit]


def _with_ignored(commit: Item, root: Path, names: list[str], history: History) -> Item:
    """Return the commit's item with what keeps a file from being added."""
    left = [name for name in names if name not in history.blobs]
    if commit.passed or not history.readable or not left:
        return commit
    kept = {name: by for name in left if (by := ignored_by(root, name))}
    if not kept:
        return commit
    lines = [f"{by} keeps git from adding {name}." for name, by in kept.items()]
    lines.append("Delete that line, or: git add -f " + " ".join(kept))
    return replace(commit, message="\n".join([*lines, commit.message]))


def check_files(day: Day, handin: Handin, *, tasks_pass: bool = True) -> list[Item]:
    """Check what a day hands in, but for the commit.

    Args:
        day: from the kit's manifest.
        handin: what the student's folder holds.
        tasks_pass: whether the day's tasks do; until then no row counts.
    """
    from labkit.handin.figure import check_figure  # it brings MuJoCo

    checks = {
        "figure": lambda: [check_figure(day, handin)],
        "worksheet": lambda: check_worksheet(day, handin),
        "log": lambda: [check_rows(day, handin, tasks_pass=tasks_pass)],
    }
    found: list[Item] = []
    for what, names in _ITEMS.items():
        file = day.files.get(what, "")
        if file in handin.unread:
            says = f"{file} {handin.unread[file]}."
            found += [Item(name, "wrong", says) for name in names]
        elif file:
            found += checks[what]()
    asked = item_names(day)
    return [item for item in found if item.name in asked]


def wanted_names(day: Day, handin: Handin) -> list[str]:
    """Return the files to commit: what the day asks for, helpers and drawings."""
    own = [name for name, is_kits in handin.pictures.items() if not is_kits]
    names = dict.fromkeys([*day.files.values(), *handin.files, *handin.notebook, *own])
    if handin.notebook:  # the script is only made of it
        del names[day.files["script"]]
    return list(names)


def check_commit(day: Day, handin: Handin, history: History) -> Item:
    """Check that a fresh clone of the last commit holds what the folder holds.

    Args:
        day: from the kit's manifest.
        handin: what is in the folder.
        history: the last commit, with the hashes of `wanted_names`.
    """
    if not history.readable:
        return Item("commit", "todo", "This folder is no git repository: git init")
    contents = {**handin.files, **handin.notebook}
    there = {*contents, *handin.unread, *handin.pictures}
    wanted = wanted_names(day, handin)
    left = [
        name
        for name in wanted
        if name in there and not history.holds(name, contents.get(name))
    ]
    says = []
    if left:
        says.append(f"Not committed as they are now: {visible(', '.join(left), 600)}.")
    if absent := [name for name in wanted if name not in there]:
        says.append(f"Not there yet: {', '.join(absent)}.")
    if not says:
        return Item("commit")
    command = f'git add -A && git commit -m "Day {day.number}"'
    return Item("commit", "todo", "\n".join([*says, command]))

"""Gaps of the last commit: files that it lacks, or that would not work in a clone."""

import ast
import contextlib
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from labkit.base.text import count
from labkit.fresh.clone import ignored_by, uncommitted
from labkit.lesson.day import Day
from labkit.lesson.student_files import retrospectives
from labkit.lesson.untrusted_files import helpers_of
from labkit.lesson.week import WORK
from labkit.report.week_retro import no_numbers, without_numbers
from robo47.paths import ROOT

# Two parts at least: "/" alone, or "/s" in a unit, is no path.
_ABSOLUTE = re.compile(r"(/[\w.-]+){2,}|[A-Za-z]:[\\/]\w|~[/\\]\w|file://")
# Links and pictures of Markdown.
_LINKED = re.compile(r"\]\(\s*<?([^)>\s]+)|src=[\"']([^\"']+)")
# A line of a template that nobody has replaced, or a cell of a table.
_ASKS = "What `make fresh` found"
_BLANK = re.compile(
    r"(?:^\s*(?:\d+\.\s+)?|\|\s*)"
    r"\*\(your (?:words|drawing|answer|prediction|number|reason)\)\*\s*(?:$|(?=\|))",
    re.MULTILINE,
)


def findings(days: Sequence[Day], clone: Path, root: Path = ROOT) -> list[str]:
    """Return what the last commit lacks, a line each.

    Args:
        days: of the clone, whose files are looked at.
        clone: its folder.
        root: what it is a clone of.
    """
    weeks = sorted({day.folder.name for day in days})
    lacks = _only_here(days, clone, root)
    blank = _unfinished(days, clone, root)
    found = [f"{name}: {why}" for name, why in sorted([*lacks.items(), *blank])]
    return found + [line for week in weeks for line in _absolute(clone / week, clone)]


def _only_here(days: Sequence[Day], clone: Path, root: Path) -> dict[str, str]:
    """Return what is in the student's folder and not in the commit, with the reason."""
    lacks = uncommitted(root)
    for diary in _diaries(days, clone):  # `make report` fills numbers in at any time
        name = diary.relative_to(clone).as_posix()
        words = without_numbers(_text(diary))
        if name in lacks and words == without_numbers(_text(root / name)):
            del lacks[name]
    for name in sorted({n for day in days for n in day.files.values()}):
        here, there = (root / name).is_file(), (clone / name).is_file()
        if here and not there and name not in lacks:
            rule = ignored_by(name, root)
            lacks[name] = f"ignored by git ({rule})" if rule else "not in the commit"
    for day in days:
        own = day.work.read_bytes() if day.work.is_file() else b""
        for name in helpers_of(root, day.files["script"], own):
            if not (clone / name).is_file():
                lacks[name] = f"{day.work.name} imports it; not in the commit"
    return lacks


def _unfinished(
    days: Sequence[Day], clone: Path, root: Path
) -> Iterator[tuple[str, str]]:
    """Yield what the days that were begun hand in, and is not there or has blanks.

    A sheet is looked at as it is in the student's folder: what it still needs is then
    known before it is committed. Whether what is written is good, `make check` says.
    """
    for day in days:
        files = day.files
        if not any((place / files["script"]).is_file() for place in (clone, root)):
            continue
        for what, name in files.items():
            there = [p / name for p in (root, clone) if (p / name).is_file()]
            if not there:
                yield name, f"not there; day {day.number} hands it in"
            elif what == "worksheet":
                yield from _blanks(there[0], name)
        if day == days[-1]:  # the last day ends the week
            for diary in retrospectives(day.week, clone):
                name = diary.relative_to(clone).as_posix()
                here = root / name if (root / name).is_file() else diary
                yield from _blanks(here, name)
                if no_numbers(_text(diary)) and not no_numbers(_text(here)):
                    yield name, "its numbers are not committed yet"


def _diaries(days: Sequence[Day], root: Path) -> list[Path]:
    weeks = {day.week.number: day.week for day in days}
    return [
        path for _, week in sorted(weeks.items()) for path in retrospectives(week, root)
    ]


def _text(sheet: Path) -> str:
    return sheet.read_text("utf-8", errors="replace") if sheet.is_file() else ""


def unwritten(days: Sequence[Day], root: Path) -> list[Path]:
    """Return the retrospectives whose part on `make fresh` is still blank.

    It can be written only after a fresh clone was tried, so it is asked for then and
    is no gap before.

    Args:
        days: of a week.
        root: the student's folder.
    """
    if not any((root / day.files["script"]).is_file() for day in days):
        return []
    diaries = _diaries(days, root)
    return [it for it in diaries if any(map(_BLANK.search, _on_fresh(_text(it))))]


def _on_fresh(text: str) -> list[str]:
    """Return the sections of a sheet that ask what `make fresh` found."""
    return [part for part in re.split(r"^(?=## )", text, flags=re.M) if _ASKS in part]


def _blanks(sheet: Path, name: str) -> Iterator[tuple[str, str]]:
    """Yield what nobody has filled in yet."""
    text = _text(sheet)
    for later in _on_fresh(text):
        text = text.replace(later, "")
    if no_numbers(text):
        yield name, "its numbers are not filled in yet; make report"
    if blank := len(_BLANK.findall(text)):
        yield name, f"{count(blank, 'place')} still to fill in"


def _absolute(week: Path, clone: Path) -> Iterator[str]:
    """Yield the lines that name a place which other machines do not have."""
    scripts = ((path, _texts(path)) for path in sorted((week / WORK).glob("*.py")))
    sheets = ((path, _links(path)) for path in sorted((week / "docs").glob("*.md")))
    for path, named in [*scripts, *sheets]:
        name = path.relative_to(clone).as_posix()
        for number, text in named:
            if _ABSOLUTE.match(text) and "\n" not in text:
                what = f"{text[:60]!r} is a path of this machine alone"
                yield f"{name}, line {number}: {what}"


def _texts(script: Path) -> Iterator[tuple[int, str]]:
    with contextlib.suppress(SyntaxError, ValueError):  # its lab says so itself
        for node in ast.walk(ast.parse(script.read_bytes())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.lineno, node.value


def _links(sheet: Path) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(_text(sheet).splitlines(), 1):
        yield from ((number, found[1] or found[2]) for found in _LINKED.finditer(line))

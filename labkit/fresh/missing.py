"""Gaps of the last commit: files that it lacks, or that would not work in a clone."""

import ast
import contextlib
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from labkit.base.text import count
from labkit.fresh.clone import ignored_by, uncommitted
from labkit.lesson.day import Day
from labkit.lesson.own_files import helpers_of
from labkit.report.week_retro import no_numbers, without_numbers
from robo47.paths import ROOT

# Two parts at least: "/" alone, or "/s" in a unit, is no path.
_ABSOLUTE = re.compile(r"(/[\w.-]+){2,}|[A-Za-z]:[\\/]\w|~[/\\]\w|file://")
_LINKED = re.compile(r"\]\(\s*<?([^)>\s]+)|src=[\"']([^\"']+)")  # in Markdown
# A line of a template that nobody has replaced, or a cell of a table.
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
    lacks = _only_here(days, weeks, clone, root)
    blank = _unfinished(days, clone, root)
    found = [f"{name}: {why}" for name, why in sorted([*lacks.items(), *blank])]
    return found + [line for week in weeks for line in _absolute(clone / week, clone)]


def _only_here(
    days: Sequence[Day], weeks: Sequence[str], clone: Path, root: Path
) -> dict[str, str]:
    """Return what is in the student's folder and not in the commit, with the reason."""
    lacks = uncommitted(root)
    for week in weeks:  # `make report` fills numbers in at any time
        for diary in _diaries(clone / week):
            name = diary.relative_to(clone).as_posix()
            if name in lacks and _own_words(diary) == _own_words(root / name):
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
        if day == days[-1]:  # which ends the week
            for diary in _diaries(clone / day.folder.name):
                name = diary.relative_to(clone).as_posix()
                here = root / name if (root / name).is_file() else diary
                yield from _blanks(here, name)
                if no_numbers(_text(diary)) and not no_numbers(_text(here)):
                    yield name, "its numbers are not committed yet"


def _diaries(week: Path) -> list[Path]:
    return sorted((week / "docs").glob("RETRO_*.md"))


def _own_words(diary: Path) -> str:
    """Return a retrospective without the numbers that `make report` fills in."""
    return without_numbers(_text(diary)) if diary.is_file() else ""


def _text(sheet: Path) -> str:
    return sheet.read_text("utf-8", errors="replace")


def _blanks(sheet: Path, name: str) -> Iterator[tuple[str, str]]:
    """Yield what nobody has filled in yet."""
    text = _text(sheet)
    if no_numbers(text):
        yield name, "its numbers are not filled in yet; make report"
    if blank := len(_BLANK.findall(text)):
        yield name, f"{count(blank, 'place')} still to fill in"


def _absolute(week: Path, clone: Path) -> Iterator[str]:
    """Yield the lines that name a place which other machines do not have."""
    for script in sorted((week / "work").glob("*.py")):
        nodes: list[ast.AST] = []
        with contextlib.suppress(SyntaxError, ValueError):  # its lab says so itself
            nodes = list(ast.walk(ast.parse(script.read_bytes())))
        for node in nodes:
            if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
                continue
            text = node.value
            if _ABSOLUTE.match(text) and "\n" not in text:
                yield _line(script, clone, node.lineno, text)
    for sheet in sorted((week / "docs").glob("*.md")):
        for number, line in enumerate(_text(sheet).splitlines(), 1):
            for link in _LINKED.finditer(line):
                if _ABSOLUTE.match(target := link[1] or link[2]):
                    yield _line(sheet, clone, number, target)


def _line(path: Path, clone: Path, number: int, text: str) -> str:
    name = path.relative_to(clone).as_posix()
    return f"{name}, line {number}: {text[:60]!r} is a path of this machine alone"

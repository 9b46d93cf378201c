"""What is here and not in a clone of the last commit, or would not work in it."""

import ast
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from robo47.checker.deliverables.handin import day_files
from robo47.lesson.day import Day
from robo47.paths import ROOT
from robo47.week.clone import ignored_by, uncommitted

# Two parts at least: "/" alone, or "/s" in a unit, is no path.
_ABSOLUTE = re.compile(r"(/[\w.-]+){2,}|[A-Za-z]:[\\/]\w|~[/\\]\w|file://")
_LINKED = re.compile(r"\]\(\s*<?([^)>\s]+)|src=[\"']([^\"']+)")  # in Markdown


def findings(days: Sequence[Day], clone: Path, root: Path = ROOT) -> list[str]:
    """Return what the last commit lacks, a line each.

    Args:
        days: of the clone, whose files are looked at.
        clone: its folder.
        root: what it is a clone of.
    """
    lacks = uncommitted(root)
    for name in sorted({n for day in days for n in day_files(day).values()}):
        here, there = (root / name).is_file(), (clone / name).is_file()
        if here and not there and name not in lacks:
            rule = ignored_by(name, root)
            lacks[name] = f"ignored by git ({rule})" if rule else "not in the commit"
    weeks = sorted({day.folder.name for day in days})
    for script, module in (
        m for week in weeks for m in _imports(clone / week / "work")
    ):
        for name in (f"{module}.py", f"{module}/__init__.py"):
            path = script.parent.relative_to(clone) / name
            if (root / path).is_file() and not (clone / path).is_file():
                lacks[path.as_posix()] = f"{script.name} imports it; not in the commit"
    found = [f"{name}: {why}" for name, why in sorted(lacks.items())]
    return found + [line for week in weeks for line in _absolute(clone / week, clone)]


def _imports(work: Path) -> Iterator[tuple[Path, str]]:
    """Yield the modules that the student's files import, by file."""
    for script, tree in _trees(work):
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
            else:
                continue
            yield from ((script, name.partition(".")[0]) for name in names if name)


def _absolute(week: Path, clone: Path) -> Iterator[str]:
    """Yield the lines that name a place which other machines do not have."""
    for script, tree in _trees(week / "work"):
        for node in ast.walk(tree):
            if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
                continue
            text = node.value
            if _ABSOLUTE.match(text) and "\n" not in text:
                yield _line(script, clone, node.lineno, text)
    for sheet in sorted((week / "docs").glob("*.md")):
        text = sheet.read_text("utf-8", errors="replace")
        for number, line in enumerate(text.splitlines(), 1):
            for link in _LINKED.finditer(line):
                if _ABSOLUTE.match(target := link[1] or link[2]):
                    yield _line(sheet, clone, number, target)


def _line(path: Path, clone: Path, number: int, text: str) -> str:
    name = path.relative_to(clone).as_posix()
    return f"{name}, line {number}: {text[:60]!r} is a path of this machine alone"


def _trees(work: Path) -> Iterator[tuple[Path, ast.AST]]:
    for script in sorted(work.glob("*.py")):
        try:
            yield script, ast.parse(script.read_bytes())
        except (SyntaxError, ValueError):  # its lab says so itself
            continue

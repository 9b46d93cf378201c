"""Gives a day another number, or another week: its files, and its number in them.

Git moves the files that it knows, so their history remains. Other documents that name
the day, a student's work and the log stay as they are, and the result lists them.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from labkit.base import git
from labkit.lesson.day import Day
from labkit.lesson.week import WORK
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

TEXTS = (".py", ".md", ".toml")
OUTPUTS = re.compile(r"<!-- \w+: .*?<!-- end -->", re.DOTALL)  # made anew


class Renumbering(NamedTuple):
    """The result of a move."""

    files: list[tuple[Path, Path]]  # pairs of the old and the new path
    left: list[str]  # places that name it and were not touched: "file, line 3: text"


def move(day: Day, number: int, folder: Path, name: str) -> Renumbering:
    """Give a day another number, in a week's folder; its week.toml is not written.

    Args:
        day: as it is now.
        number: a new one.
        folder: of the week, which is there; it may be the day's own.
        name: of the script, "game" for src/dayN_game.py.

    Raises:
        Robo47Error: a file of the new number is there already.
    """
    stem = f"day{number}_{name}"
    pairs = [
        (path, folder / _renamed(path, day, number, stem)) for path in _files_of(day)
    ]
    for _, to in pairs:
        if to.exists():
            raise Robo47Error(f"{shown(to)} is there already; nothing was moved")
    for path, to in pairs:
        to.parent.mkdir(parents=True, exist_ok=True)
        _move(path, to)
    for to in _texts(to for _, to in pairs):
        text = to.read_text("utf-8")
        new = renumbered(text, day, number, stem)
        if new != text:
            to.write_text(new, "utf-8", newline="\n")
    _remember(folder / f"day{number}" / "day.toml", day, stem)
    left = list(_remaining_names(day, number, [to for _, to in pairs]))
    return Renumbering(pairs, left)


def _files_of(day: Day) -> list[Path]:
    """Return the day's own files and folders in its week's folder."""
    n = day.number
    found = [day.own]
    for place, name in (("src", f"day{n}_*"), ("docs", f"day{n}[-_.]*"),
                        ("figures", f"day{n}_*")):  # fmt: skip
        found += sorted((day.folder / place).glob(name))
    return found


def _renamed(path: Path, day: Day, number: int, stem: str) -> Path:
    """Return where a file belongs, from the week's folder."""
    name = path.relative_to(day.folder).as_posix()
    if path == day.source:
        return Path("src") / f"{stem}.py"
    return Path(re.sub(rf"\bday{day.number}(?!\d)", f"day{number}", name))


def _move(path: Path, to: Path) -> None:
    """Move a file or a folder, with git where git knows it."""
    try:
        done = git.run("mv", str(path), str(to), folder=ROOT, seconds=git.SECONDS)
    except git.GitError:
        done = None
    if done is None or done.returncode:
        path.rename(to)


def _texts(paths: Iterator[Path]) -> Iterator[Path]:
    """Yield the files with text among files and folders, tests under their new name."""
    for path in paths:
        for one in sorted(path.rglob("*")) if path.is_dir() else [path]:
            old = re.match(r"test_day(\d+)(.*)", one.name)
            wanted = re.fullmatch(r"day(\d+)", path.name)
            if old and wanted and old[1] != wanted[1]:
                named = one.with_name(f"test_day{wanted[1]}{old[2]}")
                _move(one, named)
                one = named
            if one.suffix in TEXTS and one.is_file():
                yield one


def renumbered(text: str, day: Day, number: int, stem: str) -> str:
    """Return a text of the day's own with its new number.

    A task's id is one in quotes, in parentheses, or behind "task", "region" and the
    like: 8.1 may be a length, too.

    Args:
        text: of a file.
        day: as it was.
        number: the new one.
        stem: of the script, without ".py".
    """
    n = day.number
    text = re.sub(rf"\b{Path(day.script).stem}\b", stem, text)
    text = re.sub(
        rf"\b((?:lesson_|test_)?[dD]ay ?){n}(?!\d|\.\d)", rf"\g<1>{number}", text
    )
    calls = (
        r"\bDAY=|\b(?:find_day|complete_lab)\(|^number = |\bload_day\(|"
        r"\bsentences\(|\bconstants\.py "
    )
    text = re.sub(rf"({calls}){n}\b", rf"\g<1>{number}", text, flags=re.MULTILINE)
    ids = "|".join(re.escape(task.id) for task in day.tasks)
    one = rf"(?:{ids})(?!\d)"
    before = r"\b[Tt]asks? |TASK=|--task |region |^\"\"\"|# tasks? "
    several = rf"((?:{before}){one}(?:(?:,| and| to|, and)? {one})*)"
    quoted = rf"([\"'(`]{one}[\"')`])"

    def new_ids(found: re.Match[str]) -> str:
        return re.sub(rf"(?<![\d.]){n}\.(?=\d)", f"{number}.", found[0])

    for pattern in (several, quoted):
        text = re.sub(pattern, new_ids, text, flags=re.MULTILINE)
    return text


def _remember(manifest: Path, day: Day, stem: str) -> None:
    """Write the script's former name into day.toml, which `make update` reads."""
    text = manifest.read_text("utf-8")
    before = [*day.was, day.script]
    listed = ", ".join(f'"{one}"' for one in before)
    text = re.sub(r"^was = \[[^\]]*\]\n", "", text, count=1, flags=re.MULTILINE)
    script = f'script = "{stem}.py"\n'
    manifest.write_text(
        text.replace(script, f"{script}was = [{listed}]\n", 1), "utf-8", newline="\n"
    )


def _remaining_names(day: Day, number: int, own: list[Path]) -> Iterator[str]:
    """Yield the places that still name the day, or may: for a person to look at."""
    n = day.number
    ids = "|".join(re.escape(task.id) for task in day.tasks)
    name = rf"\b[dD]ay ?{n}(?!\d|\.\d)|\bDAY={n}\b"
    own_words = re.compile(rf"{name}|(?<![\d.])(?:{ids})(?![\d.]*\d)")
    elsewhere = re.compile(rf"{name}|[\"'`](?:{ids})[\"'`]|\b[Tt]ask (?:{ids})\b")
    inside = {one for path in own for one in (path, *path.rglob("*")) if one.is_file()}
    others = {
        path
        for folder in ("", "robo47", "tests", "docs", "site", day.folder.name)
        for path in (ROOT / folder).glob("**/*" if folder else "*")
        if path.suffix in TEXTS and path.is_file() and not _skipped(path)
    }
    for path in sorted(inside | others):
        if path.suffix not in TEXTS:
            continue
        text = OUTPUTS.sub(lambda m: "\n" * m[0].count("\n"), path.read_text("utf-8"))
        named = own_words if path in inside else elsewhere
        for i, line in enumerate(text.splitlines(), 1):
            found = named.search(line)
            if found and not line.startswith("was = "):
                yield f"{shown(path)}, line {i}: {found[0]}"


def _skipped(path: Path) -> bool:
    """Return whether a file is somebody's own, fetched, or the tests' own material."""
    skipped = {WORK, "node_modules", ".venv"}
    material = ROOT / "tests" in path.parents[1:]
    return material or bool(skipped & set(path.parts)) or path.name == "CHANGELOG.md"

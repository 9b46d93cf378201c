"""A digest of all that decides the outcome of a day's tests and of its catalogue.

The files are found, not listed: the day's folder, its lab, and what these and the
catalogue's tests import, deferred imports and names in strings included. Of Python
outside the weeks' folders the statements count, without comments and docstrings. Of a
week's folder the text counts, because the checker quotes a lab's comments and reads the
docstrings of mistakes. Hints, titles and documents decide nothing.
"""

import ast
import hashlib
import re
import sys
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from labkit.base import git
from labkit.lesson.day import Day
from robo47.paths import ROOT, TWIN_XML

# Where the names of a catalogue's imports begin.
TESTS = (
    "catalogue",
    "inprocess",
    "judged",
    "test_days_catalogue",
    "test_days_judging",
    "test_odd_ways",
)
# Entries of a manifest that only a reader sees.
PROSE = {
    *("title", "see", "says", "read", "hints", "guide", "minutes"),
    *("figure", "worksheet", "was", "retrospectives", "soon", "days"),
}
_ONLY_READ = re.compile(r"\.(md|png|webp|svg|cff)$|^bench/|^tests/catalogues\.txt$")
_OUTPUTS = re.compile(r"<!-- run: .*?<!-- end -->", re.DOTALL)
PINS = r"(?m)^(?:numpy|mujoco|scipy)==.*"  # of constraints.txt
_DEFINITIONS = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def digest(day: Day) -> str:
    """Return 16 digits that change when something changes that decides a verdict."""
    found = hashlib.sha256()
    for path in sorted(files_of(day)):
        name = path.relative_to(ROOT).as_posix()
        found.update(f"{name} {_mark(path, _stamp(path))}\n".encode())
    pins = re.findall(PINS, (ROOT / "constraints.txt").read_text("utf-8"))
    found.update("\n".join(pins).encode())
    return found.hexdigest()[:16]


def files_of(day: Day) -> set[Path]:
    """Return the files that decide the outcome of a day's tests and its catalogue.

    Its pictures, its tab and its tests count, and what they take of the library; the
    parts of the machine that show them do not.
    """
    own = [day.own / f"{name}.py" for task in day.tasks for name in task.functions]
    library = [_file(f"robo47.{name}", ()) for name in day.library]
    tests = [ROOT / "tests" / f"{name}.py" for name in TESTS]
    found = imported_by([day.source, *own, *tests, *filter(None, library)], day)
    found |= imported_by(day.own.glob("*.py"), day, without="labkit")
    others = [day.own / "day.toml", day.folder / "week.toml", TWIN_XML]
    others += (day.own / "submissions").rglob("*.py")
    return {*found, *(path for path in others if path.is_file())}


def machine_digest(days: Sequence[Day]) -> str:
    """Return 16 digits that change when the machine or the code of these days does.

    The machine is all that is committed outside the weeks' folders. Of documents only
    the outputs count. Pictures, benchmarks and the records themselves do not.

    Raises:
        GitError: there is no repository that lists the files.
    """
    own = [f"{day.own.relative_to(ROOT).as_posix()}/" for day in days]
    own += [day.source.relative_to(ROOT).as_posix() for day in days]
    done = git.run("ls-files", "-s", "-z", folder=ROOT, seconds=git.SECONDS)
    found = hashlib.sha256()
    for line in sorted(str(done.stdout).split("\0")):
        name = line.partition("\t")[2]
        of_a_week = re.match(r"w\d+-", name) and not name.startswith(tuple(own))
        if not of_a_week and not _ONLY_READ.search(name):
            found.update(f"{line}\n".encode())
    found.update("".join(_outputs(days)).encode())
    return found.hexdigest()[:16]


def _outputs(days: Iterable[Day]) -> Iterator[str]:
    """Yield the outputs in the documents of some days, with their commands."""
    names = {day.folder / name for day in days for name in (day.guide, "README.md")}
    for path in sorted({ROOT / "README.md", *names}):
        if path.is_file():
            yield from _OUTPUTS.findall(path.read_text("utf-8"))


def missed(day: Day) -> list[str]:
    """Return the kit's files that this process has loaded and the digest leaves out."""
    files = {getattr(one, "__file__", None) for one in list(sys.modules.values())}
    paths = {Path(name) for name in files if name}
    kits = {
        path for path in paths if {ROOT, ROOT / ".venv"} & {*path.parents} == {ROOT}
    }
    return sorted(str(path.relative_to(ROOT)) for path in kits - files_of(day))


def imported_by(begin: Iterable[Path], day: Day, without: str = "") -> set[Path]:
    """Return files, and what they import, however indirectly.

    Args:
        begin: the files.
        day: whose they are.
        without: a package whose modules are left out.
    """
    found, left, names = set[Path](), [*begin], set[str]()
    beside = (day.source.parent,)  # where a lab finds `dayN_mujoco`
    while left:
        path = left.pop()
        if path in found or not path.is_file():
            continue
        found.add(path)
        imports = _imports(path, _stamp(path))
        new = {part for name in imports for part in _heads(name)} - names
        names |= new
        asked = (name for name in new if name.partition(".")[0] != without)
        left += filter(None, (_file(name, beside) for name in asked))
    return found


def _stamp(path: Path) -> tuple[int, int]:
    """Return what changes when a file is written: it is read again then."""
    status = path.stat()
    return status.st_mtime_ns, status.st_size


def _heads(name: str) -> Iterator[str]:
    """Yield "a", "a.b" and "a.b.c" of "a.b.c": each is run at its import."""
    parts = name.split(".")
    yield from (".".join(parts[: i + 1]) for i in range(len(parts)))


def _file(name: str, beside: tuple[Path, ...]) -> Path | None:
    """Return the file of a module of ours; None of another one."""
    path = Path(*name.split("."))
    for folder in (ROOT, ROOT / "tests", *beside):
        for file in (folder / path / "__init__.py", folder / path.with_suffix(".py")):
            if file.is_file() and file != ROOT / "conftest.py":
                return file
    return None


@cache
def _imports(path: Path, _: tuple[int, int]) -> frozenset[str]:
    """Return the names of modules that a file may import, and of what is in them."""
    found, package = set[str](), path.relative_to(ROOT).parent.parts
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level] if node.level else ()
            module = ".".join([*above, *filter(None, [node.module])])
            found |= {f"{module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found |= {*re.findall(r"^(?:robo47|labkit)(?:\.\w+)+$", node.value)}
    return frozenset(found)


@cache
def _mark(path: Path, _: tuple[int, int]) -> str:
    """Return the digest of what counts of a file."""
    return hashlib.sha256(_content(path).encode()).hexdigest()


def _content(path: Path) -> str:
    """Return what counts of a file."""
    text = path.read_text("utf-8")
    if path.suffix == ".toml":
        return repr(_without_prose(tomllib.loads(text)))
    if path.suffix != ".py" or path.relative_to(ROOT).parts[0].startswith("w"):
        return text
    return repr(_statements(ast.parse(text)))


def _without_prose(entry: Any) -> Any:
    """Return a manifest without the entries that only a reader sees."""
    if isinstance(entry, list):
        return [_without_prose(one) for one in entry]
    if not isinstance(entry, dict):
        return entry
    return {k: _without_prose(v) for k, v in entry.items() if k not in PROSE}


def _statements(node: Any) -> Any:
    """Return a tree as tuples, alike in all versions of Python, without docstrings."""
    if isinstance(node, list):
        return [_statements(one) for one in node]
    if not isinstance(node, ast.AST):
        return node
    fields = {
        name: value for name, value in ast.iter_fields(node) if value not in (None, [])
    }
    if isinstance(node, _DEFINITIONS) and ast.get_docstring(node, clean=False):
        fields["body"] = node.body[1:]
    return (type(node).__name__, *((k, _statements(v)) for k, v in fields.items()))

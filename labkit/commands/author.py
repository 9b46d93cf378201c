"""Is a day that you write as it must be? Its files, mistakes, tests, documents, style.

    make author DAY=8                         all of it, that day's alone
    python3 scripts/author_day.py 8           the same
    python3 scripts/author_day.py 8 --fast    without its tests

What is not right is told with its file and line, and with what to do.
Exit code: 0 all as it must be, 1 something to fix, 2 could not run.
"""

import os
import re
import sys
import time
from collections.abc import Callable, Iterator

from labkit.author import looks
from labkit.base import cli, processes
from labkit.commands import docs, notebook
from labkit.lesson.day import Day, day_numbers, find_day
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

TESTS = ("test_days.py", "test_days_judging.py", "test_days_catalogue.py")
TOLD = "test_a_file_is_told_what_the_catalogue_says"  # the catalogue has better words
MOST_FAILURES = 10  # that are told
MARKS = "not soak and not browser and not network"


def run(day: Day, *command: str) -> tuple[int, list[str]]:
    """Return the exit code and the lines of a Python command about a day."""
    variables = {**os.environ, "ROBO47_DAY": str(day.number), "COLUMNS": "80"}
    done = processes.run([sys.executable, *command], env=variables, cwd=ROOT)
    return done.returncode, (done.stdout + done.stderr).splitlines()


def catalogue(day: Day) -> Iterator[str]:
    """Yield each way of the catalogue that is not told what it must be."""
    code, lines = run(day, "tests/catalogue.py", str(day.number))
    if any(line.startswith("Traceback") for line in lines):
        own = [ln for ln in lines if f"{day.own}{os.sep}" in ln] or lines[-3:-2]
        lines = [own[-1].strip(), lines[-1]]
    yield from lines if code else ()


def tests(day: Day) -> Iterator[str]:
    """Yield the tests that fail: those of every day, for this one, and its own."""
    files = [f"tests/{name}" for name in TESTS] + [str(day.own)]
    of_library = (f"tests/test_{module}.py" for module in day.library)
    files += [name for name in of_library if (ROOT / name).is_file()]
    quiet = ("-q", "-q", "--tb=short", "-rN", "--no-header", "-p", "no:cacheprovider")
    code, lines = run(
        day, "-m", "pytest", *files, *quiet, "-m", MARKS, "-k", f"not {TOLD}"
    )
    if code:
        yield from (_failures(lines, shown(day.own)) or lines[-5:])[:MOST_FAILURES]
        yield f"more: ROBO47_DAY={day.number} .venv/bin/python -m pytest " + files[0]


def _failures(lines: list[str], own: str) -> list[str]:
    """Return a line on each test that fails: its name, where, the error."""
    found = []
    for block in re.split(r"^_{3,} ", "\n".join(lines), flags=re.MULTILINE)[1:]:
        name = block.partition(" ___")[0]
        places = re.findall(r"^(\S+:\d+): in", block, re.MULTILINE)
        place = next((p for p in reversed(places) if p.startswith(own)), places[:1])
        errors = re.findall(r"^E +(.+)", block, re.MULTILINE)[:1]
        where = place if isinstance(place, str) else "".join(place)
        found.append(f"{name} ({where}): {''.join(errors)}")
    return found


def documents(day: Day) -> Iterator[str]:
    """Yield what the documents do not show as it is."""
    if drift := docs.renew(docs.documents_of(day), check=True):
        yield f"{drift} outputs are not today's. To insert: make docs DAY={day.number}"


def notebooks(day: Day) -> Iterator[str]:
    """Yield that the notebook is not what the lab makes."""
    path = notebook.notebook_of(day)
    if not path.exists() or path.read_text("utf-8") != notebook.build(day):
        yield f"{shown(path)} is not the lab's: make notebook DAY={day.number}"


def style(day: Day) -> Iterator[str]:
    """Yield what the linter says of the day's files."""
    paths = [day.own, day.source, *(ROOT / "robo47" / f"{m}.py" for m in day.library)]
    files = [str(path) for path in paths if path.exists()]
    ruff = ("-m", "ruff")
    code, lines = run(day, *ruff, "check", "--output-format=concise", "-q", *files)
    yield from lines if code else ()
    if run(day, *ruff, "format", "--check", "-q", *files)[0]:
        yield f"to format: .venv/bin/python -m ruff format {shown(day.own)}"


Part = Callable[[Day], Iterator[str]]
PARTS: dict[str, Part] = {
    "files": looks.faults,
    "catalogue": catalogue,
    "documents": documents,
    "notebook": notebooks,
    "style": style,
    "tests": tests,
}


def look(name: str, part: Part, day: Day) -> bool:
    """Print how one part of a day is; return whether it is as it must be."""
    began = time.monotonic()
    try:
        with cli.busy(name):
            found = list(part(day))
    except Robo47Error as error:
        found = [str(error)]
    print(f"{cli.verdict(not found)}  {name:10}{time.monotonic() - began:6.1f} s")
    for line in found:
        print(cli.wrapped(f"    {line}", "    "))
    return not found


def main() -> int:
    """Look at a day."""
    parser = cli.parser(__doc__)
    parser.add_argument("day", type=cli.day, nargs="?", help="default: the kit's last")
    parser.add_argument("--fast", action="store_true", help="without its tests")
    options = parser.parse_args()
    number = options.day or max(day_numbers(), default=1)
    day = find_day(number)
    print(f"Day {number}: {day.title}, in {shown(day.own)}/")
    wrong = []
    for name, part in PARTS.items():
        skipped = options.fast and name == "tests"
        wrong += [] if skipped or look(name, part, day) else [name]
        if wrong == ["files"]:  # nothing else could say more than that
            break
    says = f"not yet as it must be: {', '.join(wrong)}" if wrong else ""
    return cli.conclude(not wrong, says or "all as it must be")

"""Is a day that you write as it must be? Its files, mistakes, tests, documents, style.

    make author DAY=8                         all of it, that day's alone
    python3 scripts/author_day.py 8           the same
    python3 scripts/author_day.py 8 --fast    without its tests
    make author TASK=8.3                      one task alone, in seconds

What is not right is told with its file and line, and with what to do.
Exit code: 0 all as it must be, 1 something to fix, 2 could not run.
"""

import os
import re
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec

from labkit.base import cli, git, processes
from labkit.base.exchange import Exchange, Question
from labkit.check.as_student import faults_of
from labkit.commands import docs
from labkit.commands.new import worksheet_of
from labkit.handin.worksheet import split_sections
from labkit.judge.answers import InTurn
from labkit.judge.ask import Draw, stacked
from labkit.judge.row import rows_of
from labkit.judge.written import faults as row_faults
from labkit.lesson import notebook
from labkit.lesson.constants import TABLE_OF
from labkit.lesson.day import Day, Task, all_days, day_numbers, find_day, find_task
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import find_regions
from labkit.report.week_labs import run_labs
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

TESTS = ("test_days.py", "test_days_judging.py", "test_days_catalogue.py")
TOLD = "test_a_file_is_told_what_the_catalogue_says"  # the catalogue has better words
MOST_FAILURES = 10  # that are told
MARKS = "not soak and not browser and not network"


def faults(day: Day) -> Iterator[str]:
    """Yield what is missing or does not fit between a day's files, with its remedy."""
    parts = (
        _regions,
        _names,
        _functions,
        _guide,
        _links,
        _worksheet,
        _pictures,
        _tabs,
        _committed,
    )
    for part in parts:
        yield from part(day)


def _regions(day: Day) -> Iterator[str]:
    manifest = shown(day.own / "day.toml")
    source = shown(day.source)
    wanted = {(task.id, name) for task in day.tasks for name in task.functions}
    regions = find_regions(read_script(day.source), source)
    found = {(region.task, region.function): region.start + 1 for region in regions}
    for task, name in sorted(wanted - set(found)):
        yield (
            f"{source}: no region {task} in {name}, which {manifest} asks for. Put "
            f"`# region {task}` and `# endregion {task}` around its body"
        )
    for task, name in sorted(set(found) - wanted):
        yield (
            f"{source}, line {found[task, name]}: region {task} in {name}, which "
            f"{manifest} does not know. Add it to the functions of task {task}"
        )


def _names(day: Day) -> Iterator[str]:
    """Yield the functions that another day has as well: robo47.mine holds all."""
    own = {name for task in day.tasks for name in task.functions}
    for other in all_days():
        if other.number != day.number:
            theirs = {name for task in other.tasks for name in task.functions}
            for name in sorted(own & theirs):
                yield (
                    f"{shown(day.own / 'day.toml')}: day {other.number} has a function "
                    f"{name} too; give this one another name"
                )


def _functions(day: Day) -> Iterator[str]:
    for name, row in rows_of(day).items():
        if not callable(getattr(row.lab, name, None)):
            yield f"{shown(day.source)}: no function {name}"
            continue
        calls = row.ask.inputs
        file = f"{shown(day.own)}/{name}.py"
        first = next(iter(calls(Draw(0))))
        if len(first) != len(row.arguments):
            yield (
                f"{file}: @row.inputs yields {len(first)} arguments; "
                f"{name} takes {len(row.arguments)}: {', '.join(row.arguments)}"
            )
            continue
        if isinstance(row.ask.truth, InTurn):  # which says what does not fit
            row.ask.truth(*stacked([Exchange(Question("", name, tuple(first)))]))
        task = next(one for one in day.tasks if name in one.functions)
        for says in row_faults(row.ask, task.seconds / len(task.functions)):
            yield f"{file}: {says}"


def _guide(day: Day) -> Iterator[str]:
    path = day.folder / day.guide
    if not path.is_file():
        yield f"{shown(path)} is not there; it is the guide"
        return
    headings = re.findall(r"^#+ (.+)$", path.read_text("utf-8"), re.MULTILINE)
    for task in day.tasks:
        section = task.read.partition(";")[0].removeprefix("Lab guide, ")
        if section not in headings:
            yield (
                f"{shown(day.own / 'day.toml')}, task {task.id}: {shown(path)} has no "
                f"heading {section!r}; it has {', '.join(map(repr, headings[1:]))}"
            )


def _links(day: Day) -> Iterator[str]:
    """Yield what the guide links to and is not there."""
    path = day.folder / day.guide
    text = path.read_text("utf-8") if path.is_file() else ""
    for link in re.findall(r"\]\((?!\w+:|#)([^)#\s]+)", text):
        if not (path.parent / link).exists():
            yield f"{shown(path)}: {link} is not there"


def _committed(day: Day) -> Iterator[str]:
    """Yield a student's file in the repository: the next clone would begin with it."""
    work = shown(day.work.parent)
    try:
        done = git.run("ls-files", "--", work, folder=ROOT, seconds=git.SECONDS)
    except git.GitError:
        return
    if names := done.stdout.split():
        yield f"git holds {names[0]}; take it out: git rm -r --cached {work}"


def _worksheet(day: Day) -> Iterator[str]:
    """Yield the sections that a worksheet lacks; write one where there is none."""
    if not day.worksheet:
        return
    path = day.folder / day.worksheet
    if not path.is_file():
        path.write_text(worksheet_of(day), "utf-8", newline="\n")
        yield f"{shown(path)} was not there: written from day.toml, yours to fill in"
        return
    there = split_sections(path.read_text("utf-8"))
    for name in split_sections(worksheet_of(day)):
        asked = [one for one in there if one.startswith(name.partition(":")[0])]
        if name and name != "predictions" and not asked:
            yield f"{shown(path)}: no section {name!r}, which day.toml asks for"


def _pictures(day: Day) -> Iterator[str]:
    file = day.own / "figures.py"
    if day.draw and f'"{day.draw}"' not in (file.read_text() if file.is_file() else ""):
        yield f"{shown(file)}: FIGURES has no {day.draw!r}, which day.toml draws"


def _tabs(day: Day) -> Iterator[str]:
    """Yield why the day's tabs do not load; nothing where viser is not installed."""
    if day.has("inspector") and find_spec("viser"):
        from labkit.inspector.tab import day_tabs

        try:
            day_tabs(day)
        except Robo47Error as error:
            yield str(error)


def run(day: Day, *command: str) -> tuple[int, list[str]]:
    """Return the exit code and the lines of a Python command about a day."""
    variables = {**os.environ, "ROBO47_DAY": str(day.number), "COLUMNS": "80"}
    done = processes.run([sys.executable, *command], env=variables, cwd=ROOT)
    return done.returncode, (done.stdout + done.stderr).splitlines()


def catalogue(day: Day) -> Iterator[str]:
    """Yield each way of the catalogue that is not told what it must be."""
    code, lines = run(day, "tests/catalogue.py", str(day.number))
    lines = _without_trace(day, lines)
    yield from lines if code else ()


def _without_trace(day: Day, lines: list[str]) -> list[str]:
    """Return what a command printed; of a traceback the line of the day, and why."""
    if not any(line.startswith("Traceback") for line in lines):
        return lines
    own = [ln for ln in lines if f"{day.own}{os.sep}" in ln] or lines[-3:-2]
    return [own[-1].strip(), lines[-1]]


def tests(day: Day) -> Iterator[str]:
    """Yield the tests that fail: those of every day, for this one, and its own."""
    files = [f"tests/{name}" for name in TESTS] + [str(day.own)]
    of_library = (f"tests/test_{module}.py" for module in day.library)
    files += [name for name in of_library if (ROOT / name).is_file()]
    quiet = ("-q", "-q", "--tb=short", "-rN", "--no-header", "-p", "no:cacheprovider")
    some = ("-m", MARKS, "-k", f"not {TOLD}")
    code, lines = run(day, "-m", "pytest", *files, *quiet, *some)
    if code:
        yield from (_failures(lines, shown(day.own)) or lines[-5:])[:MOST_FAILURES]
        yield f"more: ROBO47_DAY={day.number} .venv/bin/python -m pytest " + files[0]


def _failures(lines: list[str], own: str) -> list[str]:
    """Return a line on each test that fails: its name, where, the error."""
    found = []
    for block in re.split(r"^_{3,} ", "\n".join(lines), flags=re.MULTILINE)[1:]:
        name = block.partition(" ___")[0]
        places = re.findall(r"^(\S+:\d+): in", block, re.MULTILINE)
        where = [place for place in places if place.startswith(own)][-1:] or places[:1]
        errors = re.findall(r"^E +(.+)", block, re.MULTILINE)[:1]
        found.append(f"{name} ({''.join(where)}): {''.join(errors)}")
    return found


def as_student(day: Day) -> Iterator[str]:
    """Yield what a student who hands the complete lab in would be told."""
    yield from faults_of(day)
    yield from _unrecorded(day)


def _unrecorded(day: Day) -> Iterator[str]:
    """Yield the numbers that day.toml asks for and a run of the lab does not record."""
    (ran,) = run_labs([day], kits=True)
    if ran.why:
        yield f"{shown(day.source)} does not pass: {ran.why}"
        return
    for one in ran.numbers:
        wanted = one.wanted
        if one.latest is None and one.kit is None:
            yield (
                f"{shown(day.own / 'day.toml')}: no step of the lab records "
                f"{wanted.check} ({wanted.metric}), so no student can finish the day. "
                f'Add lab.record("{wanted.check}", ...), or take the entry out'
            )


def constants(day: Day) -> Iterator[str]:
    """Yield what moves, or stays, otherwise than the day's list of constants says."""
    if not day.has("constants"):
        file = shown(day.own / "constants.py")
        yield f"{file} is not there: what the guide's numbers hang on (teaching.md)"
        return
    block = f"<!-- run: {TABLE_OF.format(day.number)} -->"
    if block not in (day.folder / day.guide).read_text("utf-8"):
        yield f"{shown(day.folder / day.guide)} has no block {block}"
    code, lines = run(day, "scripts/constants.py", str(day.number), "--check")
    yield from _without_trace(day, lines) if code else ()


def documents(day: Day) -> Iterator[str]:
    """Yield what the documents do not show as it is."""
    if drift := docs.renew(docs.documents_of(day), check=True):
        yield f"{drift} outputs are not today's. To insert: make docs DAY={day.number}"


def notebooks(day: Day) -> Iterator[str]:
    """Yield why no notebook can be made of the lab."""
    try:
        notebook.build(day)
    except Robo47Error as error:
        yield str(error)


def style(day: Day) -> Iterator[str]:
    """Yield what the linter says of the day's files."""
    paths = [day.own, day.source, *(ROOT / "robo47" / f"{m}.py" for m in day.library)]
    files = [str(path) for path in paths if path.exists()]
    ruff = ("-m", "ruff")
    code, lines = run(day, *ruff, "check", "--output-format=concise", "-q", *files)
    yield from lines if code else ()
    if run(day, *ruff, "format", "--check", "-q", *files)[0]:
        yield f"to format: .venv/bin/python -m ruff format {shown(day.own)}"


PARTS = {
    "files": faults,
    "catalogue": catalogue,
    "student": as_student,
    "constants": constants,
    "documents": documents,
    "notebook": notebooks,
    "style": style,
    "tests": tests,
}


def look(name: str, day: Day) -> bool:
    """Print how one part of a day is; return whether it is as it must be."""
    began = time.monotonic()
    found = []
    try:
        with cli.busy(name):
            for line in PARTS[name](day):
                found.append(line)
    except Robo47Error as error:  # what was found before it stands
        found.append(str(error))
    print(f"{cli.verdict(not found)}  {name:10}{time.monotonic() - began:6.1f} s")
    for line in found:
        print(cli.wrapped(f"    {line}", "    "))
    return not found


def one_task(day: Day, task: Task) -> int:
    """Look at one task alone, which takes seconds and needs no guide yet."""
    print(f"Task {task.id}: {', '.join(task.functions)}, in {shown(day.own)}/")
    found = []
    for name in task.functions:
        code, lines = run(day, "tests/catalogue.py", str(day.number), f"{name}:")
        found += lines[:-1] if code else []
        print(f"{cli.verdict(not code)}  {name}: {lines[-1] if lines else 'nothing'}")
    told = list(faults_of(day, task.id))
    print(f"{cli.verdict(not told)}  make check, on the lab's own file")
    for line in [*found, *told]:
        print(cli.wrapped(f"    {line}", "    "))
    return cli.conclude(not (found or told), f"task {task.id}")


def main() -> int:
    """Look at a day."""
    parser = cli.parser(__doc__)
    parser.add_argument("day", type=cli.day, nargs="?", help="default: the kit's last")
    parser.add_argument("--fast", action="store_true", help="without its tests")
    parser.add_argument("--task", help="such as 9.3: its mistakes and its check alone")
    options = parser.parse_args()
    if options.task:
        return one_task(*find_task(options.task))
    number = options.day or max(day_numbers(), default=1)
    day = find_day(number)
    print(f"Day {number}: {day.title}, in {shown(day.own)}/")
    wrong = []
    for name in PARTS:
        skipped = options.fast and name == "tests"
        wrong += [] if skipped or look(name, day) else [name]
        if wrong == ["files"]:  # nothing else could say more than that
            break
    says = f"not yet as it must be: {', '.join(wrong)}" if wrong else ""
    return cli.conclude(not wrong, says or "all as it must be")

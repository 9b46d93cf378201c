"""Validate a day that you are writing: files, mistakes, tests, documents, style.

    make author DAY=8                         everything about this day
    python3 scripts/author_day.py 8           the same
    python3 scripts/author_day.py 8 --fast    without its tests
    make author TASK=8.3                      one task alone, in seconds

Each fault is reported with its file, its line and a remedy.
Exit code: 0 no fault, 1 something to fix, 2 could not run.
"""

import os
import re
import sys
import time
from collections.abc import Iterator

from labkit.author import display, docstring, files, ranges, stops, student, week
from labkit.base import cli, processes
from labkit.base.text import count
from labkit.commands import docs
from labkit.judge.guard import LOUD
from labkit.judge.row import rows_of
from labkit.lesson.constants import TABLE_OF
from labkit.lesson.day import Day, Task, day_numbers, find_day, find_task
from labkit.notebook.build import build as build_notebook
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

TESTS = ("test_days.py", "test_days_judging.py", "test_days_catalogue.py")
TOLD = "test_a_file_is_told_what_the_catalogue_says"  # the catalogue has better words
MOST_FAILURES = 10  # the number of failures that are printed
# Remedies for a failing test of every day, by words of its name.
REMEDIES = {
    "no_mistake_is_there_that_no_question_shows": "the slugs on one side alone give "
    "the right answer, or stop, at every question: yield an input where they differ",
    "no_two_mistakes_look_alike": "no question tells these apart: yield one where they "
    'differ, or say Row(..., alike=[{"one", "other"}])',
    "an_edge_value_has_one_right_answer": "this call has several right answers: say "
    "Row(..., at_edge=lambda ARGUMENTS: whether it has one)",
    "numbers_at_random_get_no_name": "the mistake of that name is made by any numbers: "
    "yield more inputs",
    "a_right_answer_with_rounding_noise": "tolerance=... of the Row is too small, or "
    "scale=... of its kind is not what an entry is like",
    "a_nearly_right_answer_is_close": "near=... of the Row is not what an answer may "
    "be off by and still be right in method",
    "an_answer_that_never_changes": "yield inputs with different answers",
    "accept_takes_the_labs_own": "accept=... must return None for the lab's own "
    "answer, and say what is wrong with numbers at random",
    "a_wrong_file_run_as_a_lab_fails": "record or check in the lab what these get "
    'wrong, or say why it cannot show: hidden="why"',
    "has_files_of_every_task": "write a @row.wrong for each task",
    "every_function_has_a_row": "a file dayN/FUNCTION.py with row = Row(...) for each",
    "explains_every_term": "write each term of day.toml as **term** in the guide",
    "take_the_minutes": "the guide's table and minutes in day.toml must be the same",
    "the_lab_measures_what_the_worksheet": "the first argument of lab.measured(...) is "
    "a row of the worksheet's predictions",
}
MARKS = "not soak and not browser and not network"


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
        found.append(f"{name} ({''.join(where)}): {''.join(errors)}{_remedy(name)}")
    return found


def _remedy(test: str) -> str:
    """Return what to do where a test of every day fails, behind its words."""
    known = [remedy for word, remedy in REMEDIES.items() if word in test]
    return f". To do: {known[0]}" if known else ""


def fitting(day: Day) -> Iterator[str]:
    """Yield what does not fit between a day's files; print what is still to write."""
    yield from files.faults_of(day)
    NOTES.extend(files.unwritten(day))


def docstrings(day: Day) -> Iterator[str]:
    """Yield what docstrings say and is not so; print what is worth a look."""
    for name, row in rows_of(day).items():
        for fault in docstring.faults_of(row):
            yield f"{shown(day.source)}, {name}: {fault}"
        for fault in docstring.capitals(row):
            yield f"{shown(day.own / name)}.py: {fault}"
        for fault in stops.faults_of(row):
            yield f"{shown(day.own / name)}.py: {fault}"
        if typed := docstring.unlike_its_questions(row):
            NOTES.append(
                f"{shown(day.source)}, {name}: its docstring has {', '.join(typed)}, "
                f"and no first question or answer has. To have a case run, write it "
                f"as {name}(...) -> ..."
            )


def spans(day: Day) -> Iterator[str]:
    """Print the arguments that are smaller or larger in the lab than in a question."""
    NOTES.extend(ranges.faults_of(day))
    yield from ()


def constants(day: Day) -> Iterator[str]:
    """Yield what moves, or stays, otherwise than the day's list of constants says."""
    if not day.has("constants"):
        file = shown(day.own / "constants.py")
        yield f"{file} is missing: the constants behind a number (docs/authors.md)"
        return
    block = f"<!-- run: {TABLE_OF.format(day.number)} -->"
    if block not in (day.folder / day.guide).read_text("utf-8"):
        yield f"{shown(day.folder / day.guide)} has no block {block}"
    code, lines = run(day, "scripts/constants.py", str(day.number), "--check")
    yield from _without_trace(day, lines) if code else ()


def documents(day: Day) -> Iterator[str]:
    """Yield what the documents do not show as it is."""
    if drift := docs.renew(docs.documents_of(day), check=True):
        changed = f"{count(drift, 'output')} changed"
        yield f"{changed}. To insert the new text: make docs DAY={day.number}"


def notebooks(day: Day) -> Iterator[str]:
    """Yield why no notebook can be made of the lab."""
    try:
        build_notebook(day, fresh=True)
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
    "files": fitting,
    "docstrings": docstrings,
    "ranges": spans,
    "catalogue": catalogue,
    "student": student.faults_of,
    "tabs": display.tabs,
    "pictures": display.pictures,
    "constants": constants,
    "documents": documents,
    "notebook": notebooks,
    "capstone": week.faults_of,
    "style": style,
    "tests": tests,
}
NOTES: list[str] = []  # remarks of the present part that are no faults


def look(name: str, day: Day) -> bool:
    """Print how one part of a day is; return whether it is as it must be."""
    began = time.monotonic()
    NOTES.clear()
    found = []
    try:
        with cli.busy(name):
            for line in PARTS[name](day):
                found.append(line)
    except Robo47Error as error:  # the earlier findings remain
        found.append(str(error))
    print(f"{cli.verdict(not found)}  {name:10}{time.monotonic() - began:6.1f} s")
    for line in [*found, *(f"to look at: {note}" for note in NOTES)]:
        print(cli.wrapped(f"    {line}", "    "))
    return not found


def one_task(day: Day, task: Task) -> int:
    """Look at one task alone, which takes seconds and needs no guide yet."""
    print(f"Task {task.id}: {', '.join(task.functions)}, in {shown(day.own)}/")
    rows, found = rows_of(day), []
    for name in task.functions:
        _ = rows[name].ask  # a row that is not whole stops here, with its reason
        code, lines = run(day, "tests/catalogue.py", str(day.number), f"{name}:")
        found += lines[:-1] if code else []
        found += [*docstring.faults_of(rows[name]), *docstring.capitals(rows[name])]
        found += stops.faults_of(rows[name])
        print(f"{cli.verdict(not code)}  {name}: {lines[-1] if lines else 'nothing'}")
    told = list(student.check(day, task.id))
    print(f"{cli.verdict(not told)}  make check, on the lab's own file")
    for line in [*found, *told]:
        print(cli.wrapped(f"    {line}", "    "))
    return cli.conclude(not (found or told), f"task {task.id}")


def main() -> int:
    """Look at a day."""
    os.environ[LOUD] = "1"  # an author sees the errors of the checker's searches
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
    if files.write_worksheet(day):
        print(f"wrote {shown(day.folder / day.worksheet)}, yours to fill in")
    wrong = []
    for name in PARTS:
        skipped = options.fast and name == "tests"
        wrong += [] if skipped or look(name, day) else [name]
        if wrong == ["files"]:  # nothing else could say more than that
            last = day.tasks[-1].id
            says = "The other checks need these files. One task can be checked alone: "
            print(cli.wrapped(f"    {says}make author TASK={last}", "    "))
            break
    says = f"faults in: {', '.join(wrong)}" if wrong else ""
    return cli.conclude(not wrong, says or "no faults")

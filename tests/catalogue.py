"""A day's catalogue: ways to write its functions, and what each must be told.

    python tests/catalogue.py 6              all of day 6: what differs, totals
    python tests/catalogue.py 6 spring       with messages, what is named like that
    python tests/catalogue.py 6 --labs       with whose functions the day's lab passes
    python tests/catalogue.py 6 --some-labs  the same of a tenth, which changes

Ways stand in the day's function files (`labkit.judge.row`). Whole files of students
stand in `submissions/`; each opens with `# task 1.4: SLUG` (or `# tasks 1.1 1.3:
passed`) and, below it, what the student did. Where a mistake cannot show when the file
runs as a lab, the first line says why: `# task 1.6: typed-in (not in a run: the lab has
one Panda)`.
"""

import contextlib
import functools
import io
import os
import re
import sys
import textwrap
import time
import types
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import digests
import inprocess
import whole

from labkit.judge import Verdict, answers
from labkit.judge.row import rows_of
from labkit.lesson.day import Day, find_day
from labkit.lesson.lab import Lab
from labkit.lesson.lab_module import load_lab

_HEADER = re.compile(
    r"# tasks? ((?:\d+\.\d+ )*\d+\.\d+): ([a-z0-9A-Z+-]+)( \(not in a run: .+\))?"
    r"\n# .+\n"
)
FEW = {11: 6}  # poses, at each of which a box is asked 120 times; elsewhere 15 inputs
FORK = 0.03  # seconds of a run that a child saves, at least: it costs some itself
STATUS = {"right": "passed", "close": "close", "wrong": "wrong"}


class Entry(NamedTuple):
    """One way to write functions of a day.

    Attributes:
        name: "wrong/quat_xyzw" of a file, "pd_torque: mean-gains" of a way.
        status: "right", "close" or "wrong".
        tasks: whose functions it writes.
        expected: what it must be told: a mistake, or "passed".
        runs: whether the lab, run with it, fails.
        path: of the file; None of a way.
        code: by function, of a way.
        also: other names for the same numbers.
        named: whether making it again names it: then what is always asked tells.
    """

    name: str
    status: str
    tasks: tuple[str, ...]
    expected: str
    runs: bool
    path: Path | None = None
    code: Mapping[str, Callable] = {}
    also: frozenset[str] = frozenset()
    named: bool = False

    @property
    def group(self) -> str:
        """What it stands with: a function whose ways these are, or the files."""
        return "submissions" if self.path else self.name.partition(":")[0]

    def is_told(self, verdict: Verdict) -> bool:
        """Return whether a verdict is what the entry must be told."""
        said = verdict.mistake or verdict.status
        return said == self.expected or said in self.also


def entries(day: Day, *statuses: str) -> list[Entry]:
    """Return a day's catalogue, by default of all three statuses."""
    wanted = statuses or tuple(STATUS)
    return [*submissions(day, *wanted), *ways(day, *wanted)]


def submissions(day: Day, *folders: str) -> list[Entry]:
    """Return the files in a day's `submissions/`."""
    found = []
    for folder_name in folders or STATUS:
        for path in sorted((day.own / "submissions" / folder_name).glob("*.py")):
            header = _HEADER.match(path.read_text("utf-8"))
            if header is None:
                raise ValueError(f"{path} does not say its task and mistake on top")
            tasks, slug, hidden = header.groups()
            name = f"{folder_name}/{path.stem}"
            found.append(
                Entry(name, folder_name, tuple(tasks.split()), slug, not hidden, path)
            )
    return found


def ways(day: Day, *statuses: str) -> list[Entry]:
    """Return the ways in a day's function files."""
    tasks = {name: task.id for task in day.tasks for name in task.functions}
    return [
        Entry(
            f"{function}: {way.slug or f'right {i}'}",
            way.status,
            (tasks[function],),
            way.slug or "passed",
            not (way.hidden or way.reached),  # the small function's own way is run
            code={function: way.code},
            also=frozenset().union(*(one for one in row.alike if way.slug in one)),
            named=way.named,
        )
        for function, row in rows_of(day).items()
        for i, way in enumerate(row.ways)
        if way.status in (statuses or STATUS)
    ]


def told(day: Day, entry: Entry) -> dict[str, Verdict]:
    """Return the verdict on each of an entry's tasks."""
    script = entry.path or day.source
    if entry.code:  # what else stands in the complete lab is right, and not asked again
        day = _without_needs(day)
    only = entry.tasks[0] if len(entry.tasks) == 1 else None
    fresh = 8 if entry.named else 1
    found = inprocess.verdicts(day, script, only, instead=entry.code, fresh=fresh)
    return {task: found[task] for task in entry.tasks}


@functools.cache
def _without_needs(day: Day) -> Day:
    return replace(day, tasks=tuple(replace(task, needs=()) for task in day.tasks))


class FirstFailure(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """A lab's check failed: whatever follows, the lab ends with exit code 1."""


class Impatient(Lab):
    """The lab, which stops at the first check that fails."""

    def _judge(self, *arguments) -> None:
        super()._judge(*arguments)
        if self.failed:
            raise FirstFailure


def written(day: Day, entry: Entry) -> Mapping[str, Callable]:
    """Return the functions of a day that an entry writes, by name."""
    if entry.path is None:
        return entry.code
    own = types.ModuleType(entry.path.stem)
    exec(compile(entry.path.read_text("utf-8"), str(entry.path), "exec"), vars(own))
    names = {f for task in day.tasks for f in task.functions}
    return {k: v for k, v in vars(own).items() if k in names}


def run_as_lab(
    day: Day,
    change: Callable[[ModuleType], None] | None = None,
    trials: int = 50,
    said: io.StringIO | None = None,
) -> int:
    """Return the exit code of a day's lab.

    Args:
        day: whose complete script is run, without logging, in this process.
        change: is given the script to alter; then the first failure ends the run.
        trials: on how many random inputs.
        said: takes what the lab prints.
    """
    lab = load_lab(day.source)
    if change:
        change(lab)
        lab.Lab = Impatient
    counts = [k for k in ("TRIALS", "LIBRARY_TRIALS") if hasattr(lab, k)]
    vars(lab).update(dict.fromkeys(counts, trials))
    arguments, sys.argv = sys.argv, [str(day.source), "--no-log"]
    try:
        quiet = warnings.catch_warnings(action="ignore")
        with quiet, contextlib.redirect_stdout(said or io.StringIO()) as out:
            return lab.main()
    except FirstFailure:
        return 1
    except Exception as error:
        if change is None:
            raise
        out.write(f"it stops with {type(error).__name__}: {error}")
        return 1  # a lab that stops has not passed, whatever stopped it
    finally:
        sys.argv = arguments


def passing(day: Day, some: Iterable[Entry], trials: int = 50) -> list[Entry]:
    """Return the entries with whose functions a day's lab passes.

    The lab is run once. Where it first calls a function, a child of this process goes
    on with each way to write it: what comes before is that of the complete lab. Where
    that is little, the lab is run again instead.
    """
    left = [(one, written(day, one)) for one in some]
    again, passed, this = [], [], os.getpid()
    said = io.StringIO()
    code = 1
    try:
        branching = partial(_branch, left=left, again=again, passed=passed)
        code = run_as_lab(day, branching, trials, said)
    finally:
        if os.getpid() != this:
            os._exit(code)
    last = said.getvalue()[-300:]
    assert code == 0, f"day {day.number}, on {trials} inputs, ends with: {last}"
    for one, functions in again:
        if run_as_lab(day, partial(_put, functions=functions), trials) == 0:
            passed.append(one)
    return passed + [one for one, _ in left]


def _put(lab: ModuleType, functions: Mapping[str, Callable]) -> None:
    vars(lab).update(functions)


def _branch(lab: ModuleType, left: list, again: list, passed: list[Entry]) -> None:
    """Have a lab's run go on with each of the functions left, in a child of its own.

    Who is to be run again is noted, and with whom a child has passed.
    """
    now, began = dict(vars(lab)), time.process_time()  # what a name's call leads to

    def branch(name: str) -> None:
        cheap = time.process_time() - began < FORK or not hasattr(os, "fork")
        for pair in [one for one in left if name in one[1]]:
            left.remove(pair)
            if cheap:
                again.append(pair)
            elif not (child := os.fork()):
                left.clear()
                return now.update(pair[1])
            elif os.waitpid(child, 0)[1] == 0:
                passed.append(pair[0])

    def caller(name: str) -> Callable:
        @functools.wraps(now[name])
        def call(*args: Any, **more: Any) -> Any:
            branch(name)
            return now[name](*args, **more)

        return call

    _put(lab, {name: caller(name) for _, code in left for name in code})


def labs(day: Day, *, some: bool = False) -> int:
    """Print with which wrong functions a day's lab passes; return 1 if with any.

    Args:
        day: whose lab is run.
        some: with a sample of the functions.
    """
    answers.KEPT = 100_000  # what one way is asked, its table's others are, too
    # Nearly all show at once; what shows in few places alone needs more trials.
    left = [one for one in entries(day, "wrong") if one.runs]
    left = whole.sample(left, f"day {day.number} labs") if some else left
    for trials in (FEW.get(day.number, 15), 50):
        left = passing(day, left, trials) if left else []
    print(", ".join(one.name for one in left) or "it passes with none")
    if missed := digests.missed(day):
        print(f"loaded, and not in the day's digest (digests.py): {', '.join(missed)}")
    return 1 if left or missed else 0


def main() -> int:
    """Print what differs; return 1 if anything does."""
    day, wanted = find_day(int(sys.argv[1])), (sys.argv[2:] or [""])[0]
    if wanted in ("--labs", "--some-labs"):
        return labs(day, some=wanted == "--some-labs")
    count = wrong = 0
    for one in entries(day):
        if wanted not in one.name:
            continue
        for task, verdict in told(day, one).items():
            said, right = verdict.mistake or verdict.status, one.is_told(verdict)
            count, wrong = count + 1, wrong + (not right)
            if wanted or not right:
                print(f"{one.name} {task}: told {said}; expected {one.expected}")
                for line in (verdict.message, *verdict.measured):
                    print(textwrap.indent(textwrap.fill(line, 74), "    "))
    print(f"day {day.number}: {count} judged, {wrong} not told what they must be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

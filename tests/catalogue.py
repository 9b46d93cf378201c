"""A day's catalogue: students' files, and what each is to be told.

    python tests/catalogue.py 1              every file of day 1: what differs, totals
    python tests/catalogue.py 1 fk_hand      with messages, files named like that

Each file opens with `# task 1.4: SLUG` (or `# tasks 1.1 1.3: passed`) and, below it,
what the student did. Where a mistake cannot show when the file runs as a lab, the first
line says why: `# task 1.6: typed-in (not in a run: the lab has one Panda)`.
"""

import contextlib
import io
import re
import sys
import textwrap
import types
import warnings
from pathlib import Path
from typing import NamedTuple

import inprocess

from conftest import load_script
from labkit.judge import Verdict
from labkit.lesson.day import Day, find_day
from labkit.lesson.lab import Lab

_HEADER = re.compile(
    r"# tasks? ((?:\d+\.\d+ )*\d+\.\d+): ([a-z0-9A-Z+-]+)( \(not in a run: .+\))?"
    r"\n# .+\n"
)
STATUS = {"right": "passed", "close": "close", "wrong": "wrong"}


class Submission(NamedTuple):
    """One file: its folder, its tasks, what it must be told, whether a run shows it."""

    path: Path
    folder: str
    tasks: tuple[str, ...]
    expected: str
    runs: bool

    @property
    def name(self) -> str:
        """Return "wrong/quat_xyzw"."""
        return f"{self.folder}/{self.path.stem}"


def submissions(day: Day, *folders: str) -> list[Submission]:
    """Return every file of a day's catalogue, by default of all three folders."""
    found = []
    for folder in folders or STATUS:
        for path in sorted((day.own / "submissions" / folder).glob("*.py")):
            header = _HEADER.match(path.read_text("utf-8"))
            if header is None:
                raise ValueError(f"{path} does not say its task and mistake on top")
            tasks, slug, hidden = header.groups()
            runs = not hidden
            found.append(Submission(path, folder, tuple(tasks.split()), slug, runs))
    return found


def told(day: Day, submission: Submission) -> dict[str, Verdict]:
    """Return the verdict on each of a file's tasks."""
    return {
        task: inprocess.verdicts(day, submission.path, task)[task]
        for task in submission.tasks
    }


class FirstFailure(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """A lab's check failed: whatever follows, the lab ends with exit code 1."""


class Impatient(Lab):
    """The lab, which stops at the first check that fails."""

    def _judge(self, *arguments) -> None:
        super()._judge(*arguments)
        if self.failed:
            raise FirstFailure


def run_as_lab(day: Day, submission: Submission | None = None, trials: int = 50) -> int:
    """Return the exit code of a day's lab with a file's functions in it.

    Args:
        day: whose complete script is run, without logging, in this process.
        submission: its functions of the day's tasks take the script's place.
        trials: on how many random inputs.
    """
    lab = load_script(day.source)
    if submission:
        own = types.ModuleType(submission.path.stem)
        code = submission.path.read_text("utf-8")
        exec(compile(code, str(submission.path), "exec"), vars(own))
        names = {f for task in day.tasks for f in task.functions}
        vars(lab).update({k: v for k, v in vars(own).items() if k in names})
        lab.Lab = Impatient
    counts = [k for k in ("TRIALS", "LIBRARY_TRIALS") if hasattr(lab, k)]
    vars(lab).update(dict.fromkeys(counts, trials))
    arguments, sys.argv = sys.argv, [str(day.source), "--no-log"]
    try:
        quiet = warnings.catch_warnings(action="ignore")
        with quiet, contextlib.redirect_stdout(io.StringIO()):
            return lab.main()
    except FirstFailure:
        return 1
    except Exception:
        if submission is None:
            raise
        return 1  # a lab that stops has not passed, whatever stopped it
    finally:
        sys.argv = arguments


def main() -> int:
    """Print what differs; return 1 if anything does."""
    day, wanted = find_day(int(sys.argv[1])), (sys.argv[2:] or [""])[0]
    count = wrong = 0
    for one in submissions(day):
        if wanted not in one.name:
            continue
        for task, verdict in told(day, one).items():
            said = verdict.mistake or verdict.status
            count, wrong = count + 1, wrong + (said != one.expected)
            if wanted or said != one.expected:
                print(f"{one.name} {task}: told {said}; expected {one.expected}")
                for line in (verdict.message, *verdict.measured):
                    print(textwrap.indent(textwrap.fill(line, 74), "    "))
    print(f"day {day.number}: {count} judged, {wrong} not told what they must be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

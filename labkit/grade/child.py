"""The grader's process: packages come in on standard input, results go out as JSON.

Run as `python -m labkit.grade.child FOLDER`, where FOLDER is its own and goes with
it. A process of its own, so that a file that crashes the checker or keeps it busy for
ever costs one student's grade and not the whole class's.
"""

import contextlib
import json
import os
import pickle
import re
import select
import shutil
import sys
import tempfile
import threading
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from labkit.base.text import visible
from labkit.check import report
from labkit.check.lab_run import check_lab
from labkit.check.tasks import TaskResult, check_tasks, required_pass
from labkit.grade.hunts import HuntPackage
from labkit.grade.package import Package, unpack
from labkit.grade.result import ELSEWHERE, Mark, Result, ungraded
from labkit.handin.deliverables import check_files
from labkit.handin.handin import Item
from labkit.judge import Verdict
from labkit.lesson.day import Day, find_day
from labkit.sandbox.sandbox import Sandbox, deadline_of
from robo47.errors import FaultError

MEMORY = 6 * 1024**3  # bytes of addresses: MuJoCo and NumPy take a third of it
LINES, LINE = 200, 400  # the limits of a text: lines, and characters of a line
NOTHING_TO_RUN = ("does-not-load", "not-started", ELSEWHERE)
# Texts that differ at every run would make two grades of the same code differ.
_ADDRESS = re.compile(r"\b0x[0-9a-fA-F]{6,16}\b")
_FOLDERS = re.compile(r"robo47-(?:check|grader?)-\w{1,40}[/\\]?")


def main() -> None:
    """Grade until standard input ends."""
    folder = sys.argv[1]
    out = os.fdopen(os.dup(1), "wb")
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)  # libraries may print
    _limit_memory()
    threading.Thread(target=_end_with_parent, args=(folder,), daemon=True).start()
    while True:
        try:
            # The parent process of the kit wrote this.
            package = pickle.load(sys.stdin.buffer)
        except EOFError:
            break
        try:
            answer = _answer(package)
        except (FaultError, OSError, MemoryError) as error:  # not the student's
            name = "" if isinstance(error, FaultError) else f"{type(error).__name__}: "
            answer = {"fault": _FOLDERS.sub("", visible(f"{name}{error}", 200))}
        except Exception as error:  # a hole in the checker costs one grade
            why = f"the checker stopped with {type(error).__name__}: {visible(error)}"
            answer = _stopped(package, why)
        out.write(json.dumps(answer).encode("ascii") + b"\n")
        out.flush()
    shutil.rmtree(folder, ignore_errors=True)  # the parent may be gone


def _answer(package: Package | HuntPackage) -> dict[str, Any]:
    if isinstance(package, HuntPackage):
        return package.answer()
    return asdict(grade(package, find_day(package.day)))


def _stopped(package: Package | HuntPackage, why: str) -> dict[str, Any]:
    if isinstance(package, HuntPackage):
        return package.stopped(why)
    return asdict(ungraded(find_day(package.day), why))


def grade(package: Package, day: Day) -> Result:
    """Return a package's result.

    Args:
        package: one submission.
        day: from this kit's manifest.

    Raises:
        FaultError, OSError, MemoryError: the machine failed.
    """
    if package.problem:
        return ungraded(day, package.problem)
    day = day.named_as(lambda name: name in package.handin.files)
    with tempfile.TemporaryDirectory(prefix="robo47-grade-") as folder:
        results, lab = _run(package, day, Path(folder).resolve())
    done = required_pass(results)
    items = check_files(day, package.handin, tasks_pass=done)
    for one in lab:  # its numbers cannot be right: every class has the same columns
        items = [_with_lab(item, one) for item in items]
    result = _result(day, results, [*items, package.commit_item])
    told = "; ".join(filter(None, (package.clock, result.error)))
    return replace(result, error=told)


def _with_lab(item: Item, lab: Item) -> Item:
    """Return the numbers' item with what the lab's run says of them."""
    if item.name != "metrics":
        return item
    if not lab.passed:
        return replace(lab, name="metrics")
    return replace(item, message=f"{item.message} {lab.message}".strip())


def _run(
    package: Package, day: Day, folder: Path
) -> tuple[list[TaskResult], list[Item]]:
    """Return the tasks' results, and the lab's where they all pass."""
    handin = package.handin
    name = day.files["script"]
    if name not in handin.files:
        start = f"{name} is not there. Begin with: make start DAY={day.number}"
        verdict = Verdict("todo", "not-started", start)
        if package.elsewhere:
            says = f"{name} is not there. {package.elsewhere}"
            verdict = Verdict("todo", ELSEWHERE, says)
        elif package.clock:
            verdict = Verdict(
                "todo", "does-not-load", f"{name} is in no commit in time."
            )
        if why := handin.unread.get(name):
            verdict = Verdict("todo", "does-not-load", f"{name} {why}.")
        return [TaskResult(task, verdict) for task in day.tasks], []
    unpack(package, folder)
    with Sandbox() as sandbox:
        script = folder / day.script
        whole = deadline_of(day)
        asked = (day, script, sandbox)
        results = check_tasks(*asked, seed=package.seed, deadline=whole)
        lab = check_lab(*asked, whole) if required_pass(results) else []
    return results, lab


def _result(day: Day, results: list[TaskResult], items: list[Item]) -> Result:
    """Return the result with the words that `make check` has for it."""
    marks = [
        Mark(
            one.task.id,
            one.verdict.status,
            one.verdict.mistake,
            _tidy(f"{one.verdict.message} {one.verdict.call}".strip()),
        )
        for one in results
        if not one.task.optional
    ]
    refused = [_tidy(what) for one in results for what in one.refused]
    first = results[0].verdict
    told = []
    for one in results:  # measured numbers stay with a wrong answer alone
        verdict = replace(one.verdict, measured=()) if one.passed else one.verdict
        told.append(replace(one, printed="", verdict=verdict))
    text = report.as_text(report.Report(day, told, items), explain=True)
    return Result(
        tuple(marks),
        tuple(Mark(item.name, item.status, "", _tidy(item.message)) for item in items),
        _tidy(text) + "\n",
        _tidy(first.message) if first.mistake in NOTHING_TO_RUN else "",
        tuple(dict.fromkeys(refused))[:20],
    )


def _tidy(text: str) -> str:
    """Return a text whose lines are printable and the same at every run."""
    root = f"{os.path.realpath(tempfile.gettempdir())}{os.sep}"
    lines = text[: LINES * LINE].replace(root, "").split("\n")
    clean = []
    for line in lines[:LINES]:
        line = line[: 2 * LINE]
        indent = " " * (len(line) - len(line.lstrip(" ")))
        plain = _ADDRESS.sub("0x...", _FOLDERS.sub("", line))
        clean.append((indent + visible(plain, LINE)).rstrip())
    return "\n".join(clean)


def _end_with_parent(folder: str) -> None:
    """End as soon as nobody can send another package, also amid one."""
    if hasattr(select, "poll"):
        gone = select.poll()
        gone.register(0, 0)  # asks for nothing but its other end's closing
        gone.poll()
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(0)  # the sandbox goes with it


def _limit_memory() -> None:
    """A picture or a text that grows without end costs this process alone."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource  # not on Windows

        if sys.platform.startswith("linux"):
            hard = resource.getrlimit(resource.RLIMIT_AS)[1]
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, hard))


if __name__ == "__main__":
    main()

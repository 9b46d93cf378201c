"""From a package to a result, by this kit's checker; runs in the grader's process."""

import hashlib
import re
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from robo47.checker import report
from robo47.checker.deliverables import Item
from robo47.checker.deliverables.commit import wanted_files
from robo47.checker.deliverables.figure import check_figure
from robo47.checker.deliverables.rows import check_rows
from robo47.checker.deliverables.worksheet import check_worksheet
from robo47.checker.sandbox import Sandbox
from robo47.checker.tasks import TaskResult, check_tasks
from robo47.diagnose import Verdict
from robo47.grading.package import Package
from robo47.grading.result import Mark, Result, ungraded
from robo47.lesson.day import Day

# What is another at every run would make two grades of the same code differ.
_ADDRESS = re.compile(r"\b0x[0-9a-fA-F]{6,16}\b")
_SANDBOX = re.compile(r"[^\s'\"]*robo47-check-[^\s/\\'\"]+[/\\]?")


def grade(package: Package, day: Day) -> Result:
    """Return a package's result.

    Args:
        package: one submission.
        day: from this kit's manifest.
    """
    if package.problem:
        return ungraded(day, package.problem)
    with tempfile.TemporaryDirectory(prefix="robo47-grade-") as folder:
        clone = Path(folder).resolve() / "clone"
        clone.mkdir()
        package.unpack(clone)
        tasks, error = _tasks(package, day, clone)
        items = _items(package, day, clone, all(task.passed for task in tasks))
        result = _result(day, tasks, items, error)
        return _tidy(result, clone)


def _tasks(package: Package, day: Day, clone: Path) -> tuple[list[TaskResult], str]:
    """Return the tasks' results, and why there is nothing to run or ""."""
    name = wanted_files(day)[0]
    if name not in package.files:
        if name in package.unread:
            says = f"{name} {package.unread[name]}."
            verdict = Verdict("todo", "does-not-load", says)
        else:
            start = f"{name} is not there. Begin with: make start DAY={day.number}"
            verdict = Verdict("todo", "not-started", start)
        return [TaskResult(task, verdict) for task in day.tasks], verdict.message
    # Nobody can know the hash of a file while writing it, and it is the same tomorrow.
    seed = int(hashlib.sha256(package.files[name]).hexdigest()[:8], 16)
    with Sandbox() as sandbox:
        results = check_tasks(day, clone / name, sandbox, seed=seed)
    loads = results[0].verdict.mistake != "does-not-load"
    return results, "" if loads else results[0].verdict.message


def _items(package: Package, day: Day, clone: Path, tasks_pass: bool) -> list[Item]:
    """Return the deliverables, in the checker's order."""
    week = clone / day.folder.name
    _, worksheet, figure, log = wanted_files(day)
    written = ("definitions", "drawings", "checklist")
    checks: list[tuple[str, tuple[str, ...], Callable[[], list[Item]]]] = [
        (figure, ("figure",), lambda: [check_figure(day, week)]),
        (worksheet, written, lambda: check_worksheet(day, week)),
        (log, ("metrics",), lambda: [check_rows(day, clone, tasks_pass)]),
    ]
    items: list[Item] = []
    for file, names, check in checks:
        if file in package.unread:
            says = f"{file} {package.unread[file]}."
            items += [Item(name, "wrong", says) for name in names]
            continue
        try:
            items += check()
        except Exception as error:  # a hostile file found a hole in the checker
            says = f"{file} made the checker stop ({type(error).__name__})."
            items += [Item(name, "wrong", says) for name in names]
    return [*items, package.commit_item]


def _result(day: Day, tasks: list[TaskResult], items: list[Item], error: str) -> Result:
    """Return the result with the words that `make check` has for it."""
    marks = [
        Mark(r.task.id, r.verdict.status, r.verdict.mistake, r.verdict.message)
        for r in tasks
    ]
    return Result(
        tuple(marks),
        tuple(Mark(item.name, item.status, "", item.message) for item in items),
        report.as_text(report.Report(day, tasks, items)) + "\n",
        error,
    )


def _tidy(result: Result, clone: Path) -> Result:
    """Return a result without what changes from run to run: folders and addresses."""

    def clean(text: str) -> str:
        for path in (str(clone), clone.as_posix()):
            text = text.replace(f"{path}/", "").replace(f"{path}\\", "")
        return _ADDRESS.sub("0x...", _SANDBOX.sub("", text))

    def marks(some: tuple[Mark, ...]) -> tuple[Mark, ...]:
        return tuple(replace(mark, message=clean(mark.message)) for mark in some)

    return Result(
        marks(result.tasks),
        marks(result.items),
        clean(result.text),
        clean(result.error),
    )

"""The text of a check: a line per task and deliverable, and the next step."""

import itertools
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from labkit.check.tasks import TaskResult
from labkit.judge.mistake import Compared
from labkit.lesson.day import Day, Task, all_days

if TYPE_CHECKING:
    from labkit.handin.handin import Item

WIDTH = 80
_LABEL = {
    "passed": "passed",
    "todo": "to do",
    "wrong": "WRONG",
    "close": "CLOSE",
    "valid": "VALID, by another method",
    "unjudged": "not judged",  # the file does not load
    "inherited": "waits",
    "borrowed": "borrowed",
    "unfinished": "passed as far as it was run",
}
_COLOUR = {"passed": "32", "wrong": "31"}  # every other status is yellow
_INDENT = 7  # the column at which a message starts


@dataclass(frozen=True)
class Report:
    """One check of a day."""

    day: Day  # the day, read from its manifest
    tasks: Sequence[TaskResult]  # one result per task that was checked
    # One per deliverable; empty when one task alone was checked.
    items: Sequence["Item"] = ()
    # The other tasks that did not pass when they were last checked, where one task
    # alone was checked.
    rest: Sequence[Task] = ()

    @property
    def counted(self) -> list[TaskResult]:
        """The tasks that count: a side quest does only where it alone was checked."""
        required = [r for r in self.tasks if not r.task.optional]
        return required or list(self.tasks)

    @cached_property
    def left(self) -> list[TaskResult]:
        """The tasks that do not pass yet."""
        return [result for result in self.tasks if not result.passed]

    @property
    def done(self) -> int:
        """The number of tasks and deliverables that passed."""
        passed = sum(result not in self.left for result in self.counted)
        return passed + sum(item.passed for item in self.items)

    @property
    def total(self) -> int:
        """The number of tasks and deliverables."""
        return len(self.counted) + len(self.items)

    @property
    def passed(self) -> bool:
        """Nothing is left to do."""
        return self.done == self.total

    @property
    def problem(self) -> str:
        """The reason if the student's file does not load, else ""."""
        verdict = self.tasks[0].verdict
        return verdict.message if verdict.mistake == "does-not-load" else ""

    def next_step(self) -> str:
        """Return the next thing to do, in one sentence."""
        if self.problem:
            return "fix that line, then check again."
        for task in [one.task for one in self.counted if one in self.left]:
            named = f"task {task.id}, {' and '.join(task.functions)}"
            return f"{named}. Stuck? make hint TASK={task.id}"
        for item in self.items:
            if not item.passed:
                what = item.upcoming or item.name
                return f"the {what}: {_command_for(self.day, item)}"
        if self.items:
            return f"nothing is left to do here. Well done. {_after(self.day)}"
        for task in self.rest:
            named = f"task {task.id}, {' and '.join(task.functions)}"
            return f"{named}. Check it: make check TASK={task.id}"
        return f"check the whole day: make check DAY={self.day.number}"


def _command_for(day: Day, item: "Item") -> str:
    """Return the command for a deliverable that is left, or that says what it lacks."""
    match item.name:
        case "figure" if item.status == "todo" and day.draw:
            return f"make figures DAY={day.number}"
        case "figure" if item.status == "todo":
            return f"make view DAY={day.number} ARGS=--screenshot"
        case "lab" | "metrics":
            return f"make run DAY={day.number}"
        case "commit" if "\ngit add -A" in item.message:
            return item.message.splitlines()[-1]
    return f"make hint TASK={item.name} DAY={day.number}"


def _after(day: Day) -> str:
    """Return what comes after a day that is done, in the order in which one does it."""
    week = day.week
    number = week.number
    then = [other for other in all_days() if not other.work.is_file()]
    start = f"make start DAY={then[0].number}" if then else ""
    if day.number != max(week.days):
        return f"Your numbers: make report{'; then: ' + start if start else ''}."
    steps = [
        *([f"make capstone WEEK={number}"] if week.capstone else []),
        f"make report WEEK={number} and write your words into its RETRO",
        f"commit and make fresh WEEK={number}",
        f"make proof WEEK={number}",
        *([start] if start else []),
    ]
    return f"That was week {number}. To finish it, in this order: {'; '.join(steps)}."


def as_json(report: Report) -> dict[str, Any]:
    """Return a report for tools.

    Returns:
        "day", "passed", "done", "total", "problem", "next", and "entries": per task or
        deliverable "id", "kind", "title", "status", "mistake", "message", "measured";
        of a task also "follows" and "call".
    """
    told = ("status", "mistake", "message", "measured", "follows", "call")
    tasks = [
        {"id": result.task.id, "kind": "task", "title": result.task.title}
        | {name: getattr(result.verdict, name) for name in told}
        for result in report.tasks
    ]
    items = [
        {"id": item.name, "kind": "deliverable", "title": item.name}
        | {"status": item.status, "mistake": "", "message": item.message}
        | {"measured": ()}
        for item in report.items
    ]
    return {
        "day": report.day.number,
        "passed": report.passed,
        "done": report.done,
        "total": report.total,
        "problem": report.problem,
        "next": report.next_step(),
        "entries": tasks + items,
    }


def as_text(report: Report, *, explain: bool = False, colour: bool = False) -> str:
    """Return a report for people, in 80 columns.

    Args:
        report: of one check.
        explain: add what was measured and what the student's functions printed.
        colour: paint the states; they read well without.
    """
    day = report.day
    lines = [f"Day {day.number}: {day.title}", ""]
    if report.problem:
        lines += [*_wrapped(report.problem, 2), ""]
    width = max([24, *(len(_name(result.task)) for result in report.tasks)])
    for result in report.tasks:
        status = _status(report, result)
        lines.append(_line(_name(result.task), status, colour, width))
        lines += _below(report, result, explain)
    if report.items:
        lines.append("")
    for item in report.items:
        lines.append(_line(item.name, item.status, colour, width))
        if not report.left or explain or item.status in ("wrong", "unfinished"):
            lines += _wrapped(item.message, _INDENT)
    share = f", {100 * report.done // report.total} % of the day"
    whole = len(report.tasks) == len(day.tasks)
    lines += ["", f"{report.done} of {report.total} done{share if whole else ''}."]
    lines += _wrapped(f"Next: {report.next_step()}", 0)
    return "\n".join(lines)


def state_of(report: Report, result: TaskResult) -> tuple[str, str, list[str]]:
    """Return a task's name, its state in words, and what is said of it."""
    verdict = result.verdict
    lines = []
    if not report.problem and verdict.mistake != "unwritten":
        lines = [_sentence(report, result, explain=False), verdict.call]
    return _name(result.task), _LABEL[_status(report, result)], lines


def _status(report: Report, result: TaskResult) -> str:
    verdict = result.verdict  # a task to do can have its mistake as its label
    status = verdict.mistake if verdict.mistake in _LABEL else verdict.status
    status = "valid" if verdict.valid else status
    return "unjudged" if report.problem else status


def _below(report: Report, result: TaskResult, explain: bool) -> list[str]:
    """Return the lines below a task's: what is said, measured and printed."""
    verdict = result.verdict
    lines = []
    begun = verdict.function not in ("", result.task.functions[0])
    if not report.problem and (begun or verdict.mistake != "unwritten"):
        says = _sentence(report, result, explain)
        lines += _wrapped(says, _INDENT)
        if verdict.call and verdict.message in says:
            lines += _wrapped(verdict.call, _INDENT)
            if not explain:
                lines += _wrapped(of_arguments(result), _INDENT)
            if verdict.compared and (explain or len(report.tasks) == 1):
                lines += [f"{'':{_INDENT}}{ln}" for ln in matrix_of(verdict.compared)]
    if explain:
        for line in verdict.measured:
            lines += _wrapped(f"- {line}", _INDENT, hanging=2)
        lines += [f"{'':{_INDENT}}| {ln}" for ln in result.printed.splitlines()]
    return lines


def of_arguments(result: TaskResult) -> str:
    """Return how to see a call's arguments, if some stand there by their names."""
    lines = iter(result.verdict.measured)
    if not any(line.startswith("call: ") for line in lines):
        return ""
    results = ("returned: ", "expected: ")
    given = itertools.takewhile(lambda line: not line.startswith(results), lines)
    if not any(" = " in line for line in given):
        return ""
    return f"All arguments: make check TASK={result.task.id} ARGS=--explain"


def matrix_of(compared: Compared) -> list[str]:
    """Return a returned matrix as lines, its wrong entries in brackets."""
    texts = [[f"{x + 0.0:.4g}" for x in row] for row in compared.returned]
    marked = [
        [f"[{text}]" if off else f" {text} " for text, off in zip(*row, strict=True)]
        for row in zip(texts, compared.wrong, strict=True)
    ]
    width = max(len(text) for row in marked for text in row)
    rows = ["".join(text.rjust(width + 1) for text in row).rstrip() for row in marked]
    return ["The matrix of this call, with its wrong entries in brackets:", *rows]


def _sentence(report: Report, result: TaskResult, explain: bool) -> str:
    """Return what to say of a task: a mistake once, what follows from it in short."""
    verdict = result.verdict
    if verdict.mistake == "inherited":
        return verdict.message
    if not explain and verdict.follows in {other.task.id for other in report.left}:
        word = "follows from" if verdict.status == "close" else "builds on"
        return f"This task {word} task {verdict.follows}: solve that task first."
    if verdict.follows and verdict.status != "todo":
        also = f"This task builds on task {verdict.follows}, "
        also += "which is not right yet either."
        return f"{verdict.message} {also}"
    return verdict.message


def _name(task: Task) -> str:
    side = " (side quest)" if task.optional else ""
    return f"{task.id}  {', '.join(task.functions)}{side}"


def _line(name: str, status: str, colour: bool, width: int) -> str:
    state = _LABEL[status]
    if colour:
        state = f"\x1b[{_COLOUR.get(status, '33')}m{state}\x1b[0m"
    return f"  {name:{width}}  {state}"


def _wrapped(text: str, indent: int, hanging: int = 0) -> list[str]:
    """Return text as lines of at most 79 columns; its own line breaks stay."""
    pad = " " * indent
    wrapper = textwrap.TextWrapper(
        WIDTH - 1,
        initial_indent=pad,
        subsequent_indent=pad + " " * hanging,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line for part in text.splitlines() for line in wrapper.wrap(part)]

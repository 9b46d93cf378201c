"""From a student's file to one result per task."""

import secrets
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from labkit.check.verdicts import not_utf8, verdict_of
from labkit.judge.ask import Ask, Asked, make_round
from labkit.judge.exchange import Exchange, LoadError, replies
from labkit.judge.mistake import Verdict
from labkit.judge.problems import not_loaded
from labkit.lesson import folder
from labkit.lesson.day import Day, Task
from labkit.sandbox.library import library_of
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error


@dataclass(frozen=True)
class TaskResult:
    """How a task stands.

    Attributes:
        task: as in the manifest.
        verdict: what the answers show.
        printed: what its functions printed, for --explain.
        refused: what the sandbox refused, also where the code went on without.
    """

    task: Task
    verdict: Verdict
    printed: str = ""
    refused: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.verdict.status == "passed"


def check_tasks(
    day: Day,
    script: Path,
    sandbox: Sandbox,
    only: str | None = None,
    seed: int | None = None,
) -> list[TaskResult]:
    """Check the tasks of a day.

    Args:
        day: from the manifest.
        script: the student's file.
        sandbox: where to run it.
        only: one task's id; what it needs is run too, since it may call it.
        seed: of the fresh inputs, for a grade that can be repeated; it must not be
            known to the student.

    Returns:
        One result per task, in the manifest's order.

    Raises:
        Robo47Error: there is no such file or task, or a row of questions is missing.
    """
    wanted = [day.task(only)] if only else list(day.tasks)
    needed = {need for task in wanted for need in day.needs(task.id)}
    asked = [task for task in day.tasks if task in wanted or task.id in needed]
    rounds = rounds_of(day, asked, secrets.randbits(32) if seed is None else seed)
    if why := not_utf8(script) if script.is_file() else "":
        verdict = Verdict("todo", "does-not-load", why)
        return [TaskResult(task, verdict) for task in wanted]
    try:
        sandbox.run(
            script,
            [exchange for some in rounds.values() for exchange in _exchanges(some)],
            library_of(day),
            {task.id: set(day.needs(task.id)) for task in asked},
        )
    except LoadError as error:
        verdict = Verdict("todo", "does-not-load", not_loaded(script, error.reply))
        return [TaskResult(task, verdict, error.reply.printed) for task in wanted]
    source = script.read_text("utf-8", errors="replace")
    results: dict[str, TaskResult] = {}
    for task in asked:
        found = _result(task, rounds[task.id], source)
        results[task.id] = _following(found, day, results)
    return [results[task.id] for task in wanted]


def _exchanges(asked: Sequence[Asked]) -> list[Exchange]:
    return [exchange for one in asked for exchange in one.exchanges]


def _result(task: Task, asked: Sequence[Asked], source: str) -> TaskResult:
    """Return a task's verdict, what its functions printed and what was refused."""
    came = replies(_exchanges(asked))
    printed = next((reply.printed for reply in came if reply.printed), "")
    refused = tuple(dict.fromkeys(what for reply in came for what in reply.refused))
    return TaskResult(task, verdict_of(task, asked, source), printed, refused)


def rounds_of(day: Day, tasks: Sequence[Task], seed: int) -> dict[str, list[Asked]]:
    """Return the questions to every function of some tasks, by task.

    Raises:
        Robo47Error: the day's questions.py lacks a function of the manifest.
    """
    rows: dict[str, Ask] = folder.load(day, "questions").QUESTIONS
    if missing := [f for task in day.tasks for f in task.functions if f not in rows]:
        raise Robo47Error(f"day {day.number}'s questions.py has no row {missing[0]}")
    return {
        task.id: [make_round(task.id, f, rows[f], seed) for f in task.functions]
        for task in tasks
    }


def _following(
    found: TaskResult, day: Day, results: dict[str, TaskResult]
) -> TaskResult:
    """Return a result with the first task below it that has to be right first."""
    verdict = found.verdict
    if verdict.status in ("passed", "todo") or verdict.mistake == "missing":
        return found
    for need in day.needs(found.task.id):
        if not results[need].passed:
            return replace(found, verdict=replace(verdict, follows=need))
    return found

"""From a student's file to one result per task."""

import secrets
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from labkit.check.verdicts import not_utf8, verdict_of, why_not_loaded
from labkit.judge.ask import Ask, Robot
from labkit.judge.exchange import LoadError, Model, Question, Reply
from labkit.judge.mistake import Verdict
from labkit.judge.rounds import Round, make_round, robots
from labkit.judge.row import row_of
from labkit.lesson import folder
from labkit.lesson.day import Day, Task
from labkit.sandbox import model_copy
from labkit.sandbox.library import library_of
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error

PANDA = Robot()  # what a file that loads the robot at its top is given


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
    models = [PANDA, *robots(one for some in rounds.values() for one in some)]
    questions = {
        task.id: [_sent(q, models) for one in rounds[task.id] for q in one.questions]
        for task in asked
    }
    try:
        replies = sandbox.run(
            script,
            [question for some in questions.values() for question in some],
            [packed(robot) for robot in models],
            model_copy.facts(),
            library_of(day),
            {task.id: set(day.needs(task.id)) for task in asked},
        )
    except LoadError as error:
        verdict = Verdict("todo", "does-not-load", why_not_loaded(script, error.reply))
        return [TaskResult(task, verdict, error.reply.printed) for task in wanted]
    source = script.read_text("utf-8", errors="replace")
    come = iter(replies)
    results: dict[str, TaskResult] = {}
    for task in asked:
        own = [next(come) for _ in questions[task.id]]
        found = _result(task, verdict_of(task, rounds[task.id], own, source), own)
        results[task.id] = _following(found, day, results)
    return [results[task.id] for task in wanted]


def _result(task: Task, verdict: Verdict, replies: Sequence[Reply]) -> TaskResult:
    """Return a verdict with what its task's functions printed and were refused."""
    printed = next((reply.printed for reply in replies if reply.printed), "")
    refused = tuple(dict.fromkeys(what for r in replies for what in r.refused))
    return TaskResult(task, verdict, printed, refused)


def rounds_of(day: Day, tasks: Sequence[Task], seed: int) -> dict[str, list[Round]]:
    """Return the questions to every function of some tasks, by task.

    Raises:
        Robo47Error: the day's questions.py lacks a function of the manifest.
    """
    names = [name for task in day.tasks for name in task.functions]
    if folder.has(day, "questions"):
        rows: dict[str, Ask] = folder.load(day, "questions").QUESTIONS
    else:
        rows = {name: row_of(day, name).ask for name in names}
    if missing := [f for f in names if f not in rows]:
        raise Robo47Error(f"day {day.number}'s questions.py has no row {missing[0]}")
    return {
        task.id: [make_round(task.id, f, rows[f], seed) for f in task.functions]
        for task in tasks
    }


@lru_cache(8)  # a class is asked with the same few robots
def packed(robot: Robot) -> dict[str, Any]:
    """Return a robot as it travels; only an unchanged one is what `load` returns."""
    return model_copy.copy_model(robot.model, "" if robot.change else robot.entry)


def _sent(question: Question, models: Sequence[Robot]) -> Question:
    """Return a question as it travels: a robot as its place among the models."""
    args = tuple(
        Model(models.index(arg)) if isinstance(arg, Robot) else arg
        for arg in question.args
    )
    return Question(question.task, question.function, args)


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

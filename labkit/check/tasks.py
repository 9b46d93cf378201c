"""From a student's file to one result per task."""

import secrets
import tokenize
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from labkit.base.exchange import Exchange, LoadError, Reply, replies
from labkit.check.source_hints import arguments, unfinished
from labkit.judge.ask import Ask, Asked, make_round
from labkit.judge.judge import judge
from labkit.judge.mistake import Verdict
from labkit.judge.problems import no_answer, not_loaded, refusal
from labkit.judge.row import row_of
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
    if why := _not_utf8(script) if script.is_file() else "":
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
    return TaskResult(task, _verdict_of(task, asked, source), printed, refused)


def rounds_of(day: Day, tasks: Sequence[Task], seed: int) -> dict[str, list[Asked]]:
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


def _verdict_of(task: Task, asked: Sequence[Asked], source: str) -> Verdict:
    """Return a task's verdict: of several functions that of the first wrong one."""
    verdict = Verdict("passed")
    for one in asked:
        verdict = _of_function(task, one, source)
        if len(asked) > 1 and verdict.message and not verdict.follows:
            verdict = replace(verdict, message=f"{one.function}: {verdict.message}")
        if verdict.status != "passed":
            break
    return verdict


def _of_function(task: Task, asked: Asked, source: str) -> Verdict:
    function = asked.function
    for reply in replies([*asked.main, *asked.fresh]):
        if early := no_answer(reply, function, task.id):
            slip = early.mistake == "unwritten" and unfinished(source, function)
            return Verdict("todo", "raise-left-in", slip) if slip else early
    verdict = judge(asked, source, arguments(source, function))
    came = replies(asked.exchanges)
    if verdict.mistake == "nothing-returned":
        verdict = _nothing_returned(function, came, source, verdict)
    if verdict.status != "passed":
        refused = [what for reply in came for what in reply.refused]
        if refused:
            return refusal(refused[0], None)
    return _changed_arguments(function, came, verdict)


def _not_utf8(script: Path) -> str:
    """Return one line on a file that Python cannot read as text, or ""."""
    try:
        with tokenize.open(script) as file:
            file.read()
    except (SyntaxError, LookupError, UnicodeError):  # of "coding: rot13"
        return f"{script.name} is not in UTF-8. Save it as UTF-8 in your editor."
    return ""


def _nothing_returned(
    function: str, came: Sequence[Reply], source: str, verdict: Verdict
) -> Verdict:
    if slip := unfinished(source, function):
        return replace(verdict, message=slip)
    if any(reply.printed for reply in came):
        says = f"{verdict.message} Does it print the result instead of returning it?"
        return replace(verdict, message=says)
    return verdict


def _changed_arguments(
    function: str, came: Sequence[Reply], verdict: Verdict
) -> Verdict:
    """Return the verdict with the arguments that the function left changed."""
    changed = [name for reply in came for name in reply.changed]
    if not changed or verdict.status == "todo":
        return verdict
    name = changed[0]
    if verdict.mistake == "shares-its-argument":  # a copy at the end would not help
        says = f"{function} works in its argument {name} itself and returns it, so its "
        says += f"caller's numbers change. Begin with a copy: {name} = {name}.copy()"
        return replace(verdict, message=f"{says}.")
    says = f"{function} changed its argument {name}, which its caller still needs"
    says += f"; work on a copy: {name} = {name}.copy()" if name.isidentifier() else ""
    if verdict.status != "passed":
        return replace(verdict, message=f"{verdict.message} Besides, {says}.")
    says = f"The numbers are right, but {says}."
    return Verdict("wrong", "argument-changed", says, verdict.measured)

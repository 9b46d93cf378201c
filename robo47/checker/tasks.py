"""From a student's file to one result per task."""

import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

from robo47 import diagnose
from robo47.checker import model_copy, variant
from robo47.checker.replies import LoadError, Model, Path, Question, Reply
from robo47.checker.sandbox import Sandbox
from robo47.checker.verdicts import verdict_of, why_not_loaded
from robo47.diagnose import Verdict
from robo47.week import Day, Task


@dataclass(frozen=True)
class TaskResult:
    """How a task stands.

    Attributes:
        task: as in the manifest.
        verdict: what the answers show.
        printed: what its functions printed, for --explain.
    """

    task: Task
    verdict: Verdict
    printed: str = ""

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.verdict.status == "passed"


def check_tasks(
    day: Day,
    script: pathlib.Path,
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
        seed: of the fresh joint angles, see `variant.fresh_configurations`.

    Returns:
        One result per task, in the manifest's order.

    Raises:
        Robo47Error: there is no such file or task.
    """
    tasks = [day.task(only)] if only else list(day.tasks)
    needed = {need for task in tasks for need in _all_needs(task, day)}
    asked = [task for task in day.tasks if task in tasks or task.id in needed]
    questions = {task.id: _questions(task, seed) for task in asked}
    flat = [question for some in questions.values() for question in some]
    usual, longer = variant.models()
    copies = [
        model_copy.copy_model(usual, "panda_nohand"),
        model_copy.copy_model(longer),
    ]
    try:
        replies = sandbox.run(
            script,
            flat,
            copies,
            model_copy.facts(),
            needs={task.id: task.needs for task in day.tasks},
        )
    except LoadError as error:
        verdict = Verdict("todo", "does-not-load", why_not_loaded(script, error.reply))
        return [TaskResult(task, verdict, error.reply.printed) for task in tasks]
    results: dict[str, TaskResult] = {}
    for task in asked:
        own = list(zip(questions[task.id], replies, strict=False))
        replies = replies[len(own) :]
        results[task.id] = _result(task, own, day, results)
    return [results[task.id] for task in tasks]


def _all_needs(task: Task, day: Day) -> list[str]:
    """Return the ids of the tasks that a task builds on, however indirectly."""
    found: set[str] = set()
    waiting = list(task.needs)
    while waiting:
        need = waiting.pop()
        if need not in found:
            found.add(need)
            waiting += day.task(need).needs
    return [other.id for other in day.tasks if other.id in found]


def _questions(task: Task, seed: int | None) -> list[Question]:
    """Return the judge's calls, then a chain's: fresh angles, both Pandas, a path."""
    asked = [
        Question(
            task.id,
            call.function,
            tuple(Model(0) if isinstance(a, str) else a for a in call.args),
        )
        for call in diagnose.calls(task.id)
    ]
    for function in task.functions:
        if function in variant.FRAMES:
            fresh = variant.fresh_configurations(seed)
            asked += [
                Question(task.id, function, (Model(which), q))
                for which in range(len(variant.models()))
                for q in fresh
            ]
            if function == variant.TAKES_A_PATH:
                args = (Model(0), fresh[0], Path(variant.TO_LINK4))
                asked.append(Question(task.id, function, args))
    return asked


def _result(
    task: Task,
    own: Sequence[tuple[Question, Reply]],
    day: Day,
    results: dict[str, TaskResult],
) -> TaskResult:
    """Return a task's result; a wrong one points to the first wrong one below it."""
    verdict = verdict_of(task, own)
    printed = next((reply.printed for _, reply in own if reply.printed), "")
    if verdict.status == "wrong":
        for need in _all_needs(task, day):
            if not results[need].passed:
                also = f"Task {need}, which it may build on, is not right yet either."
                verdict = replace(verdict, message=f"{verdict.message} {also}")
                break
    return TaskResult(task, verdict, printed)

"""From a student's file to one verdict per task."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from robo47 import diagnose, panda
from robo47.checker import model_copy, variant
from robo47.checker.replies import LoadError, Model, Question, Reply
from robo47.checker.sandbox import Sandbox
from robo47.diagnose import Answer, Verdict
from robo47.paths import ROOT
from robo47.week import Day, Task

_TODO = "NotImplementedError"


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
    day: Day, script: Path, sandbox: Sandbox, only: str | None = None
) -> list[TaskResult]:
    """Check the tasks of a day.

    Args:
        day: from the manifest.
        script: the student's file.
        sandbox: where to run it.
        only: one task's id; what it needs is run too, since it may call it.

    Returns:
        One result per task, in the manifest's order.

    Raises:
        Robo47Error: there is no such file or task.
    """
    tasks = [day.task(only)] if only else list(day.tasks)
    asked = [task for task in day.tasks if task in tasks or _needed(task, tasks, day)]
    questions = [question for task in asked for question in _questions(task)]
    models = [panda.load("panda_nohand"), variant.model()]
    copies = [model_copy.copy_model(model) for model in models]
    try:
        replies = sandbox.run(script, questions, copies, model_copy.facts())
    except LoadError as error:
        why = _why_not_loaded(script, error.reply)
        verdict = Verdict("wrong", "does-not-load", why)
        return [TaskResult(task, verdict, error.reply.printed) for task in tasks]
    results: dict[str, TaskResult] = {}
    for task in asked:
        own = [
            (question, reply)
            for question, reply in zip(questions, replies, strict=True)
            if question.task == task.id
        ]
        verdict = _with_needs(_verdict(task, own), task, day, results)
        printed = next((reply.printed for _, reply in own if reply.printed), "")
        results[task.id] = TaskResult(task, verdict, printed)
    return [results[task.id] for task in tasks]


def _needed(task: Task, tasks: Sequence[Task], day: Day) -> bool:
    return any(task.id in _all_needs(other, day) for other in tasks)


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


def _questions(task: Task) -> list[Question]:
    """Return the judge's calls, then the same functions on the changed Panda."""
    calls = diagnose.calls(task.id)
    asked = [
        Question(
            task.id,
            call.function,
            tuple(Model(0) if isinstance(a, str) else a for a in call.args),
            task.without,
        )
        for call in calls
    ]
    for function in task.functions:
        if function in variant.FRAMES:
            asked += [
                Question(task.id, function, (Model(1), q))
                for q in variant.configurations()
            ]
    return asked


def _verdict(task: Task, own: list[tuple[Question, Reply]]) -> Verdict:
    """Return what a task's replies show."""
    for question, reply in own:
        if early := _without_judge(task, question, reply):
            return early
    judged = own[: len(diagnose.calls(task.id))]
    verdict = diagnose.judge(task.id, [_answer(reply) for _, reply in judged])
    if verdict.status == "passed":
        return _on_variant(own[len(judged) :]) or verdict
    refused = [what for _, reply in own for what in reply.refused]
    return _refusal(refused[0], None) if refused else verdict


def _without_judge(task: Task, question: Question, reply: Reply) -> Verdict | None:
    """Return the verdict on a reply that never was an answer."""
    function = question.function
    if reply.kind == "stopped":
        return Verdict("wrong", "stopped", f"{function} did not return: {reply.error}.")
    if reply.kind == "unsendable":
        return Verdict("wrong", "not-an-array", f"{function}: {reply.error}.")
    if reply.kind == "missing":
        says = (
            f"The file has no function {function}. To put its gap back: "
            f"make start RESET={task.id}"
        )
        return Verdict("wrong", "missing", says)
    if reply.kind == "RefusedError":
        return _refusal(reply.refused[0] if reply.refused else "", reply.line)
    if reply.kind == _TODO:
        named = re.search(r"task (\d+\.\d+)", reply.error)
        if named and named[1] != task.id:
            says = f"Waits for task {named[1]}, which it calls and which is to do."
            return Verdict("todo", "waits", says)
    return None


def _answer(reply: Reply) -> Answer:
    if not reply.kind:
        return Answer(reply.value)
    where = f" (line {reply.line})" if reply.line else ""
    return Answer(None, f"{reply.kind}: {reply.error}{where}")


def _refusal(what: str, line: int | None) -> Verdict:
    """Return the verdict on code that wanted more than its arguments."""
    where = f" (line {line})" if line else ""
    what = what.replace(str(ROOT), "").replace(ROOT.as_posix(), "")
    if what.startswith("call "):
        says = (
            f"It wants to {what}{where}. Here the point is to work the answer out "
            "yourself; the judge has MuJoCo's."
        )
        return Verdict("wrong", "not-by-hand", says)
    says = f"It wants to {what}{where}. A task needs nothing but its arguments."
    return Verdict("wrong", "refused", says)


def _on_variant(own: list[tuple[Question, Reply]]) -> Verdict | None:
    """Return the verdict on a chain that is right on the real Panda alone, or None."""
    if not own:
        return None
    values = [reply.value for _, reply in own]
    worst = variant.worst_error(own[0][0].function, values)
    if worst <= variant.AGREES:
        return None
    raised = next((reply for _, reply in own if reply.kind), None)
    how = f"stops with {raised.kind}" if raised else f"is off by {worst:.3g}"
    says = (
        "Right for this Panda, but on one whose links are a little longer and turned "
        f"it {how}: take every pos and quat from the model that is passed in."
    )
    return Verdict("wrong", "not-from-the-model", says)


def _with_needs(
    verdict: Verdict, task: Task, day: Day, results: dict[str, TaskResult]
) -> Verdict:
    """Point from a wrong task to the first wrong one below it."""
    if verdict.status in ("passed", "todo"):
        return verdict
    for need in _all_needs(task, day):
        if not results[need].passed:
            says = f"{verdict.message} It builds on {need}: get that one right first."
            return replace(verdict, message=says)
    return verdict


def _why_not_loaded(script: Path, reply: Reply) -> str:
    """Return one line on a file that Python could not load."""
    where = f"{script.name}, line {reply.line}" if reply.line else script.name
    if reply.kind == "SystemExit":
        return (
            f"{where}: it ends Python while being loaded. Keep sys.exit below "
            '`if __name__ == "__main__":`.'
        )
    if reply.kind == "RefusedError" and reply.refused:
        return f"{where}: while being loaded it wants to {reply.refused[0]}."
    if reply.kind == "stopped":
        return f"{where}: while being loaded, {reply.error}."
    return f"{where}: {reply.kind}: {reply.error}"

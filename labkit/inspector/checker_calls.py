"""The page's side of the checker: opens a file in the sandbox, asks for verdicts."""

from collections.abc import Sequence
from pathlib import Path

import mujoco

from labkit.check.tasks import PANDA, check_tasks, packed
from labkit.check.verdicts import why_not_loaded
from labkit.inspector.checks import TaskState
from labkit.inspector.student import Asker, Source
from labkit.judge.exchange import Reply
from labkit.lesson.day import Day
from labkit.sandbox import model_copy
from labkit.sandbox.library import library_of
from labkit.sandbox.sandbox import Sandbox


def source_of(day: Day, model: mujoco.MjModel, sandbox: Sandbox) -> Source:
    """Return the student's file of a day, to be opened in a sandbox.

    Args:
        day: from its manifest.
        model: the robot that the page shows: `Model(0)` in a question.
        sandbox: kept open as long as the page.
    """
    robots = [model_copy.copy_model(model), packed(PANDA)]  # ours; what `load` gives

    def opened(script: Path) -> Asker:
        return sandbox.session(script, robots, model_copy.facts(), library_of(day))

    return Source(day.work, opened, why_not_loaded, describe)


def describe(function: str, reply: Reply) -> str:
    """Return in the checker's words what a reply that is no answer means, or "".

    Args:
        function: that was called.
        reply: what came of it.
    """
    where = f" (line {reply.line})" if reply.line else ""
    match reply.kind:
        case "":
            return ""
        case "stopped":
            return f"{function} did not return: {reply.error}."
        case "missing":
            return f"The file has no function {function}."
        case "unsendable":
            return f"{function}: {reply.error}."
        case "NotImplementedError":
            return f"{function} is not written yet: {reply.error}"
        case "RefusedError":
            wanted = reply.refused[0] if reply.refused else "do more than it may"
            return f"{function} wants to {wanted}{where}."
    text = f"{reply.kind}: {reply.error}".rstrip(": ")
    return f"{function} stops with {text}{where}."


def verdicts(day: Day) -> Sequence[TaskState]:
    """Return how the student's tasks stand, as `make check` says it.

    Args:
        day: from its manifest.
    """
    with Sandbox() as sandbox:
        results = check_tasks(day, day.work, sandbox)
    return [
        TaskState(
            result.task.id,
            result.task.title,
            result.verdict.status,
            result.verdict.message,
            result.verdict.mistake,
        )
        for result in results
    ]

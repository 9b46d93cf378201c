"""The page's side of the checker: opens a file in the sandbox, asks for verdicts."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

import mujoco

from labkit.base.exchange import Reply
from labkit.check.tasks import TaskResult, check_tasks
from labkit.inspector.student import Source
from labkit.judge.problems import no_answer, not_loaded, stops_with
from labkit.lesson.day import Day
from labkit.sandbox.library import library_of
from labkit.sandbox.sandbox import Sandbox, Session


def source_of(day: Day, model: mujoco.MjModel, sandbox: Sandbox) -> Source:
    """Return the student's file of a day, to be opened in a sandbox.

    Args:
        day: from its manifest.
        model: the robot that the page shows, as it is in questions.
        sandbox: kept open as long as the page.
    """

    def opened(script: Path) -> Session:
        return sandbox.session(script, [model], library_of(day), limits=day.limits)

    tasks = {name: task.id for task in day.tasks for name in task.functions}
    return Source(day.work, opened, not_loaded, partial(describe, tasks))


def describe(tasks: Mapping[str, str], function: str, reply: Reply) -> str:
    """Return in the checker's words what a reply that is no answer means, or "".

    Args:
        tasks: whose function each is.
        function: that was called.
        reply: what came of it.
    """
    if not reply.kind:
        return ""
    verdict = no_answer(reply, function, tasks.get(function, ""))
    says = verdict.message if verdict else stops_with(reply)
    return says if function in says else f"{function}: {says}"


def verdicts(day: Day) -> Sequence[TaskResult]:
    """Return how the student's tasks stand, as `make check` says it.

    Args:
        day: from its manifest.
    """
    with Sandbox() as sandbox:
        return check_tasks(day, day.work, sandbox)

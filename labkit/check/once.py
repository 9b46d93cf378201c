"""One check of a day: its tasks, then its lab and what is handed in."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from labkit.base import cli
from labkit.lesson.day import Day
from labkit.sandbox.process import Process

if TYPE_CHECKING:
    from labkit.check.report import Report
    from labkit.handin.handin import Item
    from labkit.sandbox.sandbox import Sandbox


def check_once(
    day: Day,
    script: Path,
    task: str | None,
    seed: int,
    stop: Callable[[], bool] | None = None,
) -> "Report":
    """Check a student's file once.

    Args:
        day: from its manifest.
        script: the file; what is found is remembered where it is the day's own.
        task: the id of a task that is checked alone, or None.
        seed: of the inputs that are drawn anew.
        stop: asked during the lab's run, whether to end it.

    Raises:
        StoppedEarly: `stop` ended the lab's run; what the tasks did is remembered.
    """
    with cli.busy("checking"):
        warm = Process()  # it gets ready while MuJoCo is imported
        from labkit.check import memory
        from labkit.check.report import Report
        from labkit.check.tasks import check_tasks, required_pass
        from labkit.sandbox.sandbox import Sandbox

        with Sandbox(warm) as sandbox:
            key = memory.key_of(day) if script == day.work else ""
            results = check_tasks(day, script, sandbox, task, seed)
            done = required_pass(results)
            if key:
                memory.note(results)
                memory.remember(key, results)
            asked = done and not task
            lab = _lab(day, script, sandbox, bool(key), stop) if asked else []
    if not task:
        from labkit.handin.deliverables import check_deliverables

        lab += check_deliverables(day, tasks_pass=done)
    rest = memory.not_passed(day, task) if task and key else []
    return Report(day, results, lab, rest)


def _lab(
    day: Day,
    script: Path,
    sandbox: "Sandbox",
    own: bool,
    stop: Callable[[], bool] | None,
) -> list["Item"]:
    """Return what the lab's run says, from memory if it passed with the same files."""
    from labkit.check import memory
    from labkit.check.lab_run import check_lab

    key = memory.lab_key(day) if own else ""
    if key and memory.lab_passed(key):
        return []
    found = check_lab(day, script, sandbox, None, stop)
    if key and not found and memory.lab_key(day) == key:  # no save during the run
        memory.note_lab(key)
    return found

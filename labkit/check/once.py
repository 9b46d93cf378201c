"""One check of a day: its tasks, then its lab and what is handed in."""

from pathlib import Path
from typing import TYPE_CHECKING

from labkit.base import cli
from labkit.lesson.day import Day
from labkit.sandbox.process import Process

if TYPE_CHECKING:
    from labkit.check.report import Report


def check_once(day: Day, script: Path, task: str | None, seed: int) -> "Report":
    """Check a student's file once.

    Args:
        day: from its manifest.
        script: the file; what is found is remembered where it is the day's own.
        task: the id of a task that is checked alone, or None.
        seed: of the inputs that are drawn anew.
    """
    with cli.busy("checking"):
        warm = Process()  # it gets ready while MuJoCo is imported
        from labkit.check import memory
        from labkit.check.lab_run import check_lab
        from labkit.check.report import Report
        from labkit.check.tasks import check_tasks, required_pass
        from labkit.sandbox.sandbox import Sandbox

        with Sandbox(warm) as sandbox:
            key = memory.key_of(day) if script == day.work else ""
            results = check_tasks(day, script, sandbox, task, seed)
            done = required_pass(results)
            lab = check_lab(day, script, sandbox) if done and not task else []
    if key:
        memory.note(results)
        memory.remember(key, results)
    if not task:
        from labkit.handin.deliverables import check_deliverables

        lab += check_deliverables(day, tasks_pass=done)
    rest = memory.not_passed(day, task) if task and key else []
    return Report(day, results, lab, rest)

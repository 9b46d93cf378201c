"""One check of a day or of a task: its tasks, the lab's run, what is handed in."""

from pathlib import Path
from typing import TYPE_CHECKING

from labkit.lesson.day import Day
from labkit.sandbox.process import Process
from robo47.errors import Robo47Error
from robo47.paths import shown

if TYPE_CHECKING:
    from labkit.check.report import Report


def report_of(day: Day, script: Path, task: str | None, seed: int) -> "Report":
    """Check once and return the report.

    Args:
        day: from its manifest.
        script: the file with the functions.
        task: the id of the only task to check; None is the whole day.
        seed: of the inputs that are drawn anew.

    Raises:
        Robo47Error: the file is not there.
    """
    if not script.is_file():
        raise Robo47Error(f"{shown(script)} is not there")
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
    return Report(day, results, lab)

"""A day as its student meets it: the complete lab as a student's own file.

What an author never sees with the kit's own file: the wall, the wire and the
limits. Whoever hands the complete lab in must get full marks.
"""

import tempfile
from collections.abc import Iterator
from pathlib import Path

from labkit.check.lab_run import rehearse
from labkit.check.tasks import check_tasks
from labkit.lesson.day import Day
from labkit.sandbox.sandbox import Sandbox


def faults_of(day: Day, task: str | None = None) -> Iterator[str]:
    """Yield what a student with the complete lab would be told, a line each.

    Args:
        day: whose lab.
        task: the id of the only one to ask; by default all, and then the lab's run.
    """
    with tempfile.TemporaryDirectory(prefix="robo47-author-") as folder:
        script = Path(folder) / day.script
        script.write_bytes(day.source.read_bytes() + b"\n# a student's own\n")
        with Sandbox() as sandbox:
            results = check_tasks(day, script, sandbox, task)
            wrong = [result for result in results if not result.passed]
            for result in wrong:
                names = " and ".join(result.task.functions)
                yield (
                    f"make check judges the lab's own {names} ({result.task.id}) as "
                    f"{result.verdict.status}: {result.verdict.message}"
                )
            if wrong or task:
                return
            ran = rehearse(day, script, sandbox)
            if ran.fault:
                says = "the lab fails with its own functions behind the wall"
                yield f"{says}: {ran.fault}"
            if ran.unfinished:
                yield (
                    f"{ran.unfinished} Give its run more, `[limits] lab_seconds` in "
                    f"day.toml (now {day.lab_seconds:g}), or fewer calls"
                )

"""Verdicts on rewritten functions: the right suspect, and a repair that passes."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from labkit.base.deadline import Deadline
from labkit.hunt.case import Case, days_hunted
from labkit.hunt.script import opened
from labkit.judge.mistake import Verdict
from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import function_lines

NO_TIME = "Not judged: the functions before it used all the time that a hunt has."


class Repair(NamedTuple):
    """A function that was written anew."""

    function: str
    guilty: bool  # the mistake is in this function
    verdict: Verdict  # the verdict on the present text


def repairs(case: Case) -> list[Repair]:
    """Return what is said of each function that somebody wrote anew."""
    return judged(case, case.script.read_bytes())


def judged(
    case: Case,
    script: bytes,
    seed: int | None = None,
    deadline: Deadline | None = None,
) -> list[Repair]:
    """Return what is said of each function that is written anew in a hunted script.

    Args:
        case: which day, level and mistake.
        script: the content of the hunted script.
        seed: of the fresh inputs; None draws one.
        deadline: of all functions together; None gives each its own.
    """
    text = script.decode("utf-8-sig", errors="replace")
    found = []
    for day in days_hunted(case.of_day, case.level):
        names = [name for task in day.tasks for name in task.functions]
        own = opened(text, names)
        for name, verdict in _verdicts(day, own, seed, deadline).items():
            found.append(Repair(name, name in case.guilty, verdict))
    return found


def is_found(case: Case, repaired: list[Repair]) -> bool:
    """Return whether all that was wrong was repaired."""
    right = {r.function for r in repaired if r.guilty and r.verdict.status == "passed"}
    return right == case.guilty


def _verdicts(
    day: Day,
    own: Mapping[str, str],
    seed: int | None,
    deadline: Deadline | None,
) -> dict[str, Verdict]:
    """Return the checker's verdict on functions put into the kit's right lab."""
    from labkit.check.tasks import check_tasks
    from labkit.sandbox.sandbox import Sandbox

    if not own:
        return {}
    text = read_script(day.source)
    lines = text.splitlines()
    for name, code in own.items():
        start, end, _ = function_lines("\n".join(lines), name)
        lines[start:end] = code.splitlines()
    found = {}
    with TemporaryDirectory() as folder:
        script = Path(folder) / day.source.name
        script.write_text("\n".join(lines) + "\n", "utf-8")
        for name in own:
            task = next(task for task in day.tasks if name in task.functions)
            if deadline and deadline.over:
                found[name] = Verdict("wrong", "too-slow", NO_TIME)
                continue
            with Sandbox() as sandbox:
                (result,) = check_tasks(
                    day, script, sandbox, task.id, seed=seed, deadline=deadline
                )
            found[name] = result.verdict
    return found

"""A day as its student meets it: the complete lab as a student's own file.

What an author never sees with the kit's own file: the wall, the wire and the limits.
Whoever hands the complete lab in must get full marks, every number of their lab on the
teacher's page, and the capstone.
"""

import tempfile
from collections.abc import Iterator
from pathlib import Path

from labkit.check.own_functions import capstone_of
from labkit.check.tasks import check_tasks
from labkit.grade.child import grade
from labkit.grade.package import collect
from labkit.grade.roster import Student
from labkit.lesson.day import Day
from labkit.proof import page
from labkit.proof.capstone import NO_CAPSTONE, attempt
from labkit.proof.facts import facts_of
from labkit.report.week_labs import run_labs
from labkit.sandbox.sandbox import Sandbox
from robo47.paths import shown

# The remedy if the lab's own function takes longer than its task has.
TOO_SLOW = (
    " To do: `seconds = 60` of the task in day.toml, or smaller inputs; where the "
    "lab's function is not what takes longest, say Row(..., seconds=...)"
)
OWN = b"\n\nA_STUDENT_S_OWN = 1\n"  # the kit's own file would not be graded


def check(day: Day, task: str) -> Iterator[str]:
    """Yield what `make check TASK=...` would tell a student with the complete lab."""
    with tempfile.TemporaryDirectory(prefix="robo47-author-") as folder:
        script = _handed_in(day, Path(folder))
        with Sandbox() as sandbox:
            for one in check_tasks(day, script, sandbox, task):
                if not one.passed:
                    names = " and ".join(one.task.functions)
                    said = one.verdict.status, one.verdict.message
                    yield _fault("check", names, one.task.id, *said)


def faults_of(day: Day) -> Iterator[str]:
    """Yield what a student who hands the complete lab in would be told, a line each."""
    (ran,) = run_labs([day], kits=True)
    if ran.why:
        yield f"{shown(day.source)} does not pass: {ran.why}"
        return
    for one in ran.numbers:
        wanted = one.wanted
        if one.latest is None and one.kit is None:
            yield (
                f"{shown(day.own / 'day.toml')}: no step of the lab records "
                f"{wanted.check} ({wanted.metric}), so no student can finish the day. "
                f'Add lab.record("{wanted.check}", ...), or take the entry out'
            )
    with tempfile.TemporaryDirectory(prefix="robo47-author-") as folder:
        clone = Path(folder)
        _handed_in(day, clone)
        told = list(_grading_faults(day, clone))
        yield from told or _proof_faults(day, clone)


def _handed_in(day: Day, clone: Path) -> Path:
    """Write the complete lab where a student has theirs; return the file."""
    script = clone / day.files["script"]
    script.parent.mkdir(parents=True)
    script.write_bytes(day.source.read_bytes() + OWN)
    return script


def _grading_faults(day: Day, clone: Path) -> Iterator[str]:
    """Yield what `make grade` says is wrong, behind the wall."""
    result = grade(collect(Student("the author", clone.name, clone), day), day)
    for mark in result.tasks:
        if not mark.passed:
            names = " and ".join(day.task(mark.id).functions)
            yield _fault("grade", names, mark.id, mark.status, mark.message)
    for item in result.items:
        if item.status == "wrong":
            yield (
                f"make grade says {item.id} WRONG of the lab with its own functions "
                f"behind the wall: {item.message}"
            )
    if result.error:
        yield f"make grade cannot look at it: {result.error}"


def _fault(command: str, names: str, task: str, status: str, message: str) -> str:
    says = f"make {command} judges the lab's own {names} ({task}) as {status}: "
    return says + message + (TOO_SLOW if " is too slow: " in message else "")


def _proof_faults(day: Day, clone: Path) -> Iterator[str]:
    """Yield what the teacher's page to show lacks of a complete day."""
    student = Student("the author", clone.name, clone)
    with Sandbox() as sandbox, tempfile.TemporaryDirectory() as folder:
        facts = facts_of(day, student, Path(folder), sandbox)
        tried = NO_CAPSTONE
        if day.week.capstone:
            capstone = capstone_of(day.week)
            tried = attempt(capstone, [facts], [Path(folder)], sandbox)
    if facts.fault:
        yield f"the lab fails with its own functions behind the wall: {facts.fault}"
    lacks = [m for m in day.metrics if (m.check, m.metric) not in facts.again]
    if facts.unfinished:
        named = ", ".join(f"{m.check} ({m.metric})" for m in lacks) or "no number"
        yield (
            f"{facts.unfinished} Never run again for a student: {named}. "
            "Give its run more, `[limits] lab_seconds` in day.toml (now "
            f"{day.lab_seconds:g}), or fewer calls"
        )
    if tried.capstone and tried.stopped:
        yield f"{tried.capstone.NAME} with the day's functions: {tried.stopped}"
    page.render(page.Proof(student.name, False, "", [facts], tried, {}))

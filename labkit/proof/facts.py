"""Facts of a proof: a clone's tasks and numbers, found now and in the sandbox."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from labkit.base.git import read_history
from labkit.base.text import visible
from labkit.check.lab_run import LabRun, rehearse
from labkit.check.memory import state_of
from labkit.check.tasks import check_tasks, required_pass
from labkit.grade.package import collect, unpack
from labkit.grade.roster import Student
from labkit.handin.deliverables import check_commit, wanted_names
from labkit.handin.rows import rows_of
from labkit.lesson.day import Day
from labkit.lesson.writers import marks_of, writers_of
from labkit.report.series import series_of
from labkit.report.week_facts import DayFacts
from labkit.sandbox.sandbox import Sandbox, deadline_of
from robo47.errors import Robo47Error


@dataclass(frozen=True)
class RunDay(DayFacts):
    """The state of a student's day after its run here."""

    # The numbers that the lab gave with theirs as far as it came, by check and metric.
    again: Mapping[tuple[str, str], float] = field(default_factory=dict)
    fault: str = ""  # the first step of the lab that failed here, "" where none did
    unfinished: str = ""  # why the lab did not run to its end; "" if it did
    # The files of the folder that the commit lacks; "" if it has all.
    left: str = ""
    commit: str = ""  # the commit that ran; "" if none is known
    worksheet: str = ""  # its text, with the predictions


def facts_of(
    day: Day,
    student: Student,
    folder: Path,
    sandbox: Sandbox,
    *,
    own: bool = False,
    at: str = "",
) -> RunDay:
    """Return how a day stands; its files are left in an empty folder for the capstone.

    Args:
        day: from the kit's manifest.
        student: whose, and where the clone is.
        folder: the empty one.
        sandbox: where the functions run.
        own: it is the reader's own clone, of which git may be asked for more.
        at: the commit that was graded; by default the folder as it is.

    Raises:
        OSError, GitError, FaultError: this machine failed.
    """
    package = collect(student, day, at=at)
    unpack(package, folder)
    handin, item = package.handin, package.commit_item
    script = handin.files.get(day.files["script"])
    writers = writers_of(day, script or b"")
    sheet = handin.files.get(day.files["worksheet"], b"").decode("utf-8-sig", "replace")
    try:
        numbers = series_of(day, rows_of(day, handin), writers)
    except Robo47Error:  # no log that can be read
        numbers = series_of(day, [], writers)
    if script is None:
        begun = {task.id: "not begun" for task in day.tasks}
        return RunDay(day, begun, numbers, commit=package.commit, worksheet=sheet)
    states = {task.id: "the kit's own file" for task in day.tasks}
    ran = LabRun("", {})
    if writers.kits.isdisjoint(marks_of(script)):
        whole = deadline_of(day)
        asked = (day, folder / day.script, sandbox)
        results = check_tasks(*asked, deadline=whole)
        states = {result.task.id: state_of(result.verdict) for result in results}
        if required_pass(results):
            ran = rehearse(*asked, whole)
    if own:
        history = read_history(student.path, wanted_names(day, handin), own=True)
        item = check_commit(day, handin, history)
    left = "" if item.passed else visible(item.message.partition("\n")[0], 300)
    fault, unfinished = visible(ran.fault, 300), visible(ran.unfinished, 300)
    commit = package.commit
    again = ran.numbers, fault, unfinished
    return RunDay(day, states, numbers, *again, left, commit, sheet)

"""The grades as files: a table, one row per student, and a file for each of them."""

import csv
import hashlib
import io
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from labkit.base.text import visible
from labkit.grade.result import UNGRADED, Result
from labkit.grade.roster import Student
from robo47.errors import Robo47Error
from robo47.paths import shown

# A spreadsheet runs a text that begins like this as a formula.
_FORMULA = re.compile(r"\s*['=+@|%＝＋－＠-]")
_SEPARATORS = str.maketrans(";|", ",,")  # where half the world's spreadsheets split


@dataclass(frozen=True)
class Graded:
    """One student with all that the table and the page show.

    Attributes:
        student: from the roster.
        result: the grade.
        commit: the hash of the last commit, or "".
        minutes: from there to the deadline, by the student's own clock, negative past
            it; None without a commit.
        note: what this run has to add to the result's error, such as a failed pull.
        fault: whether this machine failed; the next run grades them.
        feedback: the file's name in feedback/.
        late: how many commits came after the deadline; None without one.
    """

    student: Student
    result: Result
    commit: str = ""
    minutes: int | None = None
    note: str = ""
    fault: bool = False
    feedback: str = ""
    late: int | None = None

    @property
    def error(self) -> str:
        """Why something could not be graded or updated; "" where all was."""
        return "; ".join(filter(None, (self.result.error, self.note)))

    @property
    def tasks_passed(self) -> int:
        """How many tasks are passed."""
        return self.result.score[0]

    @property
    def percent(self) -> float | None:
        """The share of tasks that pass; None where nobody could look at them."""
        tasks = self.result.tasks
        if any(task.status == UNGRADED for task in tasks):
            return None
        return 100 * self.tasks_passed / max(1, len(tasks))

    @property
    def late_by(self) -> tuple[int, int] | tuple[str, str]:
        """Minutes and begun days from the deadline to the commit that counts."""
        if self.late is None or self.minutes is None:
            return "", ""
        minutes = max(0, -self.minutes)
        return minutes, -(-minutes // (24 * 60))


def as_csv(class_: Sequence[Graded]) -> bytes:
    """Return the table.

    Args:
        class_: everybody, in the order to show them.

    Returns:
        CSV in UTF-8 with a byte order mark, by which spreadsheets know it.
    """
    return table(list(map(_row, class_)))


def table(rows: Sequence[Mapping[str, str | int]]) -> bytes:
    """Return a table as every grades.csv is written: rows by column as CSV."""
    return csv_of(list(rows[0]), (row.values() for row in rows))


def csv_of(head: Iterable[str], rows: Iterable[Iterable[str | int]]) -> bytes:
    """Return columns and rows as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return text.getvalue().encode("utf-8-sig")


def percent_of(share: float | None) -> str:
    """Return a share as a table has it; "" where there is none."""
    return "" if share is None else f"{share:.1f}"


def nameless(class_: Sequence[Graded], seed: int) -> list[Graded]:
    """Return a class in an order and with names that say nothing of who it is.

    Args:
        class_: everybody.
        seed: of the grading, by which the same person has the same name every day.
    """
    found = []
    for graded in class_:
        whose = os.fsencode(f"{seed} {graded.student.folder}")
        code = hashlib.sha256(whose).hexdigest()[:8]
        marks = [replace(mark, message="") for mark in graded.result.tasks]
        result = replace(graded.result, tasks=tuple(marks), error="", refused=())
        student = Student(code, code, Path())
        bare = replace(graded, student=student, result=result, commit="", note="")
        found.append(bare)
    return sorted(found, key=lambda graded: graded.student.name)


def _row(graded: Graded) -> dict[str, str | int]:
    result, mistake = graded.result, graded.result.first_mistake
    minutes, days = graded.late_by
    return {
        **who(graded.student),
        "percent": percent_of(graded.percent),
        "tasks_passed": graded.tasks_passed,
        **{task.id: _cell(graded, task.status) for task in result.tasks},
        "deliverables_passed": result.score[1],
        **{item.id: item.status for item in result.items},
        "first_mistake": plain(f"{mistake.id} {mistake.mistake}" if mistake else ""),
        "what_it_says": plain(mistake.message if mistake else ""),
        "minutes_since_commit_own_clock": _or_nothing(graded.minutes),
        "late_minutes": minutes,
        "late_days": days,
        "commits_after_deadline": _or_nothing(graded.late),
        "commit_hash": graded.commit[:10],
        "kit": result.kit,
        "seed": result.seed if result.kit else "",
        "refused": plain("; ".join(result.refused)),
        "error": plain(graded.error),
    }


def who(student: Student) -> dict[str, str | int]:
    """Return the first cells of a student's row: who it is."""
    folder = plain(printable(student.folder))
    return {"id": plain(student.id), "name": plain(student.name), "folder": folder}


def _or_nothing(number: int | None) -> int | str:
    return "" if number is None else number


def _cell(graded: Graded, status: str) -> str:
    """Return a task's status; a file that does not load is more than a task to do."""
    if status == "todo" and graded.result.does_not_load:
        return "does not load"
    return status


def plain(text: str) -> str:
    """Return a text that any spreadsheet shows as it is, in one cell, on one line."""
    line = visible(printable(text), 2000).translate(_SEPARATORS)
    return f"'{line}" if _FORMULA.match(line) else line


def printable(text: str) -> str:
    """Return a text that UTF-8 can hold: a folder's name may be any bytes."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def write_feedback(folder: Path, graded: Graded) -> None:
    """Write a student's file.

    Raises:
        Robo47Error: it cannot be written.
    """
    text = f"{graded.student.name}\n\n{graded.result.text}"
    write(folder / f"{graded.feedback}.txt", printable(text).encode("utf-8"))


def write(path: Path, content: bytes) -> None:
    """Replace a file whole, or leave it as it was; nothing to do where it is equal.

    Raises:
        Robo47Error: it cannot be written.
    """
    try:
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".new")
        with partial.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    except OSError as error:
        raise Robo47Error(
            f"{shown(path)} cannot be written: {error.strerror or error}. Close it "
            "where it is open, or choose another place with --out"
        ) from None

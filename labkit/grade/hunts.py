"""Grade a class's bug hunt: the same day, level and seed for everybody.

What counts is the hunted script as it was committed in time: it is judged anew here, in
the sandbox, by this kit's mistake. `hunt.json` and the log are the student's own word
(whom they suspected, how many runs it took), and shown as such; what contradicts the
script is said beside it.
"""

import hashlib
import io
import re
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache, partial
from pathlib import Path
from typing import Any, NamedTuple

from labkit.base.git import GitError, before, blob, files_of
from labkit.base.text import count, visible
from labkit.grade.engine import Engine, grade_package
from labkit.grade.journal import Journal, StoredResult
from labkit.grade.package import fingerprint
from labkit.grade.result import FAULT
from labkit.grade.roster import Student
from labkit.handin.handin import LIMITS
from labkit.hunt import tally
from labkit.hunt.case import FILE, Case, draw, folder_of, parsed, script_of
from labkit.hunt.verdict import Repair, is_found, judged
from labkit.lesson.day import Day, find_day
from labkit.log.rows import Row
from labkit.log.scan import scan_file
from labkit.sandbox.sandbox import deadline_of
from robo47.errors import FaultError, Robo47Error
from robo47.paths import METRICS_CSV, ROOT

LARGEST = 3_000_000  # bytes of a file that is looked at
MOST = 50  # suspicions that are read
WORDS = 300  # letters of an expectation that are shown

FOUND = "found"  # suspected by name, and repaired
REPAIRED = "repaired, not named"
NAMED = "named, not repaired"
NOT_FOUND = "not found"
NO_HUNT = "no such hunt"
UNGRADED = "not graded"
STATES = (FOUND, REPAIRED, NAMED, NOT_FOUND, NO_HUNT, UNGRADED)


class Files(NamedTuple):
    """The committed files of a hunt; b"" for a missing one."""

    case: bytes
    script: bytes
    log: bytes


@dataclass(frozen=True)
class Hunter:
    """The state of one student's hunt."""

    student: Student
    state: str  # one of `STATES`
    why: str = ""  # the reason for one of the last two states
    runs: int = 0  # the number in hunt.json
    checks: int = 0
    suspected: Sequence[tuple[str, str]] = ()  # function, what was expected, in order
    innocent: Sequence[str] = ()  # right functions that were written anew
    odd: Sequence[str] = ()  # statements that contradict the script
    said: str = ""  # the checker's sentence about a wrong repair
    wrong: int = 0  # functions that were right, and suspected or written anew
    fault: bool = False  # this machine failed: it is tried again at the next run


@dataclass(frozen=True)
class Hunt:
    """The hunt of a class."""

    day: Day
    level: int
    seed: int

    @property
    def case(self) -> Case:
        """The hunt as this kit draws it."""
        return draw(self.day, self.level, self.seed, [])

    def files(self, student: Student, deadline: int | None) -> Files:
        """Return what a student committed up to a moment, seconds since 1970.

        Raises:
            GitError: git is not there, or takes too long.
        """
        moment = int(time.time()) + 86_400 if deadline is None else deadline
        folder = folder_of(self.day)
        own = folder.parent.relative_to(ROOT).as_posix() + "/"
        commit, _ = before(student.path, moment, own)
        paths = (folder / FILE, script_of(self.day, self.level), METRICS_CSV)
        names = [path.relative_to(ROOT).as_posix() for path in paths]
        there = files_of(student.path, commit, *names) if commit else {}
        found = []
        for name in names:
            hash_, size = there.get(name, ("", 0))
            small = hash_ and size <= LARGEST
            found.append(blob(student.path, hash_) if small else b"")
        return Files(*found)


@dataclass(frozen=True)
class HuntPackage:
    """One student's hunt, without the name, as a grading process takes it."""

    day: int  # its number
    level: int
    seed: int  # the seed of the mistake
    files: Files
    kit: str  # fingerprint of the kit that collected it
    questions: int  # seed of the fresh inputs, the same for everybody
    commit: str = ""  # a journal needs this field; a hunt does not show it
    committed: int | None = None

    @property
    def fingerprint(self) -> str:
        """A hash of all that the grade depends on, but for the kit."""
        whole = hashlib.sha256()
        numbers = (self.day, self.level, self.seed, self.questions)
        for part in (repr(numbers).encode(), *self.files):
            whole.update(hashlib.sha256(part).digest())
        return whole.hexdigest()

    def answer(self) -> dict[str, Any]:
        """Return the fields of a `Hunter`, without the student.

        Raises:
            FaultError, OSError, MemoryError: the machine failed.
        """
        try:
            return _answer(self)
        except FaultError:
            raise
        except Robo47Error as error:
            return self.stopped(f"the hunted script cannot be judged: {_bare(error)}")

    def stopped(self, why: str) -> dict[str, Any]:
        """Return what stands where the hunt could not be judged to its end."""
        return {"state": UNGRADED, "why": why}


class HuntJournal(Journal):
    """The result of each student, stored as it arrives; see `Journal`."""

    def __init__(
        self, path: Path, hunt: Hunt, deadline: int | None, seed: int | None
    ) -> None:
        """Open it; one of another day, level or mistake is refused."""
        about = {"level": hunt.level, "mistake": hunt.seed}
        super().__init__(path, hunt.day, deadline, seed, **about)

    def _as_json(self, result: dict[str, Any]) -> dict[str, Any]:
        return result

    def _from_json(self, told: Any) -> dict[str, Any]:
        known = {field.name for field in fields(Hunter)} - {"student", "fault"}
        if told["state"] not in STATES or not set(told) <= known:
            raise ValueError("no result of a hunt")
        return dict(told)

    def _note(self, folder: str, kept: StoredResult) -> None:
        self._last[folder] = kept


def grade(
    hunt: Hunt, students: Sequence[Student], engine: Engine, journal: HuntJournal
) -> Iterator[Hunter]:
    """Yield how each student's hunt stands, in the roster's order.

    Each is judged in a grading process, within a memory limit and a time limit. What
    was judged before and has not changed is taken from the journal.

    Args:
        hunt: what the class was given.
        students: from the roster.
        engine: where to; it is this machine.
        journal: it knows the deadline and the seed of the fresh inputs.
    """
    work = partial(_grade_one, hunt, journal)
    each = zip(students, engine.executor.map(work, students), strict=True)
    for student, (package, found) in each:
        if package and not found.get("fault"):
            journal.keep(student.folder, package, found)
        yield Hunter(student, **found)


def _grade_one(
    hunt: Hunt, journal: HuntJournal, student: Student
) -> tuple[HuntPackage | None, dict[str, Any]]:
    """Return a student's package where it was judged now, and how the hunt stands."""
    if student.problem or not student.path.is_dir():
        why = student.problem or "there is no such folder"
        return None, {"state": UNGRADED, "why": why}
    try:
        files = hunt.files(student, journal.reference if journal.deadline else None)
        numbers = (hunt.day.number, hunt.level, hunt.seed)
        kit = fingerprint(hunt.day.number)
        package = HuntPackage(*numbers, files, kit, journal.seed)
        known = journal.find(student.folder, package)
        return (None, known) if known else (package, grade_package(package))
    except (OSError, GitError, FaultError, MemoryError, RecursionError) as error:
        why = FAULT.format(visible(error, 200) or type(error).__name__)
        return None, {"state": UNGRADED, "why": why, "fault": True}
    except Robo47Error as error:
        return None, {"state": UNGRADED, "why": _bare(error)}


def _answer(package: HuntPackage) -> dict[str, Any]:
    hunt = Hunt(find_day(package.day), package.level, package.seed)
    said, state, why = _own_account(hunt, package.files)
    if said is None:
        return {"state": state, "why": why}
    if len(package.files.script) > LIMITS["script"]:
        most = LIMITS["script"] // 1000
        return package.stopped(f"the hunted script is over {most} kB")
    case = hunt.case
    repaired = _verdicts(hunt, package.files.script, package.questions)
    anew = [one.function for one in repaired]
    found = is_found(case, repaired)
    told = said.suspected[:MOST]
    suspected = [(visible(f, 60), visible(text, WORDS)) for f, text in told]
    names = {function for function, _ in suspected}
    named = case.guilty <= names
    bad = [r for r in repaired if r.guilty and r.verdict.status != "passed"]
    rows, unread = _rows(hunt, package.files.log)
    return {
        "state": (FOUND if named else REPAIRED)
        if found
        else (NAMED if named else NOT_FOUND),
        "runs": said.runs,
        "checks": said.checks,
        "suspected": suspected,
        "innocent": [name for name in anew if name not in case.guilty],
        "odd": [*unread, *_contradictions(case, said, rows, found)],
        "said": " ".join(f"{r.function}: {r.verdict.message}" for r in bad),
        "wrong": len((names | {*anew}) - case.guilty),
    }


@lru_cache(1000)  # scripts that are alike are judged once in a process
def _verdicts(hunt: Hunt, script: bytes, questions: int) -> list[Repair]:
    return judged(hunt.case, script, questions, deadline_of(hunt.day))


def _bare(error: Exception) -> str:
    """Return an error's text without the folders of this machine."""
    return visible(re.sub(r"\S*[/\\]", "", str(error)))


def _own_account(hunt: Hunt, files: Files) -> tuple[Case | None, str, str]:
    """Return a student's own word on the hunt; None, a state and why without one."""
    if not files.case:
        return None, NO_HUNT, "no hunt is committed"
    try:
        said = parsed(files.case)
    except (ValueError, TypeError, RecursionError):
        return None, UNGRADED, f"{FILE} is broken"
    if (said.day, said.level, said.seed) != (hunt.day.number, hunt.level, hunt.seed):
        what = f"a hunt of day {said.day}, level {said.level}, seed {said.seed}"
        return None, NO_HUNT, f"{what} is committed"
    return said, "", ""


def _contradictions(
    case: Case, said: Case, rows: Sequence[Mapping[str, Any]], found: bool
) -> Iterator[str]:
    """Yield what a student's own word and the script do not agree on."""
    if said.marks and said.marks != case.marks:
        yield "their kit drew another mistake: an older kit, or an edited hunt.json"
    logged = [row for row in rows if tally.ending(row) == tally.FOUND]
    if not found and (logged or said.ended == tally.FOUND):
        where = "the log says" if logged else "hunt.json says"
        yield f"{where} found; the committed script does not repair it"
    if found and not logged:
        yield "repaired, and the log has no row of it: never judged by make hunt"
    runs = {str(row.get("value", "")).removesuffix(".0") for row in logged}
    if logged and said.runs and str(said.runs) not in runs:
        told = ", ".join(sorted(runs))
        yield f"the log says {visible(told, 40)} runs, hunt.json {said.runs}"


def _rows(hunt: Hunt, log: bytes) -> tuple[list[Row], list[str]]:
    """Return a log's rows of the hunt, and what is wrong with the log as a whole."""
    asked = (f"hunt_day{hunt.day.number}", hunt.seed, f"level {hunt.level}")
    names = ("run_id", "seed", "method")
    found = []
    try:
        for line in scan_file(io.BytesIO(log), METRICS_CSV.name):
            row = line.row
            if row is not None and tuple(row[name] for name in names) == asked:
                found.append(row)
    except Robo47Error:
        return [], ["the log's first line is not the log's header, so no row is read"]
    return found, []


def columns(hunters: Sequence[Hunter]) -> list[dict[str, str | int | None]]:
    """Return the table: a row per student, in the roster's order."""
    return [
        {
            "id": one.student.id,
            "name": one.student.name,
            "folder": one.student.folder,
            "state": one.state,
            "runs they say": one.runs,
            "checks they say": one.checks,
            "wrong suspicions": one.wrong,
            "suspected": ", ".join(function for function, _ in one.suspected),
            "written anew for nothing": ", ".join(one.innocent),
            "look at": "; ".join(one.odd),
            "why": one.why,
        }
        for one in hunters
    ]


def standings(hunters: Sequence[Hunter]) -> str:
    """Return how many there are in each state, in words."""
    number = Counter(one.state for one in hunters)
    words = [f"{number[state]} {state}" for state in STATES if number[state]]
    return f"{count(len(hunters), 'student')}: {', '.join(words)}"

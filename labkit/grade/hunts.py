"""Grade a class's bug hunt: the same day, level and seed for everybody.

What counts is the hunted script as it was committed in time: it is judged anew here, in
the sandbox, by this kit's mistake. `hunt.json` and the log are the student's own word
(whom they suspected, how many runs it took), and shown as such; what contradicts the
script is said beside it.
"""

import csv
import io
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from labkit.base.git import GitError, before, blob, files_of
from labkit.base.text import count, visible
from labkit.grade.roster import Student
from labkit.hunt import tally
from labkit.hunt.case import FILE, Case, draw, folder_of, parsed, script_of
from labkit.hunt.verdict import Repaired, is_found, judged
from labkit.lesson.day import Day
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
    """What a student committed of a hunt; b"" where there is none."""

    case: bytes
    script: bytes
    log: bytes


@dataclass(frozen=True)
class Hunter:
    """How one student's hunt stands."""

    student: Student
    state: str  # one of `STATES`
    why: str = ""  # of the last two
    runs: int = 0  # as hunt.json says
    checks: int = 0
    suspected: Sequence[tuple[str, str]] = ()  # function, what was expected, in order
    innocent: Sequence[str] = ()  # right functions that were written anew
    odd: Sequence[str] = ()  # what contradicts the script
    said: str = ""  # what the checker says of a repair that is not right
    wrong: int = 0  # functions that were right, and suspected or written anew


@dataclass(frozen=True)
class Hunt:
    """What a class was given."""

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


def grade(
    hunt: Hunt, students: Sequence[Student], deadline: int | None = None
) -> Iterator[Hunter]:
    """Yield how each student's hunt stands, one after the other."""
    known: dict[bytes, list[Repaired]] = {}
    for student in students:
        if student.problem or not student.path.is_dir():
            why = student.problem or "there is no such folder"
            yield Hunter(student, UNGRADED, why)
            continue
        try:
            files = hunt.files(student, deadline)
        except (OSError, GitError) as error:
            yield Hunter(student, UNGRADED, visible(error))
            continue
        yield _hunter(hunt, student, files, known)


def _hunter(
    hunt: Hunt, student: Student, files: Files, known: dict[bytes, list[Repaired]]
) -> Hunter:
    """Return how a student's hunt stands; scripts that are alike are judged once."""
    said, state, why = _said(hunt, files)
    if said is None:
        return Hunter(student, state, why)
    case = hunt.case
    if files.script not in known:
        known[files.script] = judged(case, files.script)
    repaired = known[files.script]
    anew = [one.function for one in repaired]
    found = is_found(case, repaired)
    told = said.suspected[:MOST]
    suspected = [(visible(f, 60), visible(text, WORDS)) for f, text in told]
    names = {function for function, _ in suspected}
    named = case.guilty <= names
    bad = [r for r in repaired if r.guilty and r.verdict.status != "passed"]
    return Hunter(
        student,
        (FOUND if named else REPAIRED) if found else NAMED if named else NOT_FOUND,
        runs=said.runs,
        checks=said.checks,
        suspected=suspected,
        innocent=[name for name in anew if name not in case.guilty],
        odd=list(_odd(case, said, _rows(hunt, files.log), found)),
        said=" ".join(f"{r.function}: {r.verdict.message}" for r in bad),
        wrong=len((names | {*anew}) - case.guilty),
    )


def _said(hunt: Hunt, files: Files) -> tuple[Case | None, str, str]:
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


def _odd(
    case: Case, said: Case, rows: Sequence[Mapping[str, str]], found: bool
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


def _rows(hunt: Hunt, log: bytes) -> list[Mapping[str, str]]:
    """Return a log's rows of the hunt, whatever else it holds."""
    text = log.decode("utf-8", "replace").replace("\0", "")
    asked = (f"hunt_day{hunt.day.number}", str(hunt.seed), f"level {hunt.level}")
    try:
        rows = [*csv.DictReader(io.StringIO(text))]
    except csv.Error:
        return []
    names = ("run_id", "seed", "method")
    return [r for r in rows if tuple(str(r.get(name)) for name in names) == asked]


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

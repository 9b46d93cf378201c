"""Grade a class: a folder with one clone per student, by this copy of the kit.

    python scripts/grade_class.py CLONES              (make grade ROOT=CLONES)
    python scripts/grade_class.py CLONES --day 1 --out grades-day1/grades.csv
    python scripts/grade_class.py CLONES --pull          update the clones first
    python scripts/grade_class.py CLONES --deadline 2026-09-04T18:00
    python scripts/grade_class.py CLONES --dask tls://10.0.0.5:8786

CLONES/roster.csv (name, folder, git) says who is in the class; without it,
each folder is a student. Beside the table: class.html (what to explain again,
who is stuck), feedback/ (a file per student) and grading.jsonl, in which each
result is kept as it comes: stop at any time, the same command goes on.
Commit times are the students' own: whoever commits sets the clock.
Exit code: 0 everybody has a row, also those who are "ungraded" (the column
error says why), 1 somebody could not be pulled or this machine failed: run it
again, 2 could not run.
"""

import argparse
import contextlib
import datetime
import os
import time
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)

from robo47 import cli
from robo47.checker.wall import wall
from robo47.errors import Robo47Error
from robo47.grading import engine, overview
from robo47.grading.classroom import Classroom, write_all
from robo47.grading.journal import Journal
from robo47.grading.overview import Course
from robo47.grading.roster import find_students
from robo47.lesson.day import find_day
from robo47.paths import shown


def parse() -> argparse.Namespace:
    """Read the command line."""
    about, usage = (__doc__ or "").split("\n", 1)
    parser = argparse.ArgumentParser(
        description=about,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("root", type=Path, metavar="CLONES", help="folder with a clone per student")
    add("--day", type=int, default=1, help="default: 1")
    add(
        "--out",
        type=Path,
        metavar="CSV",
        help="default: grades-dayN/grades.csv; a folder per day",
    )
    add("--roster", type=Path, metavar="CSV", help="default: CLONES/roster.csv")
    add("--pull", action="store_true", help="clone what is missing, update the rest")
    add(
        "--deadline",
        type=moment,
        metavar="TIME",
        help="2026-09-04T18:00, or a day, which means its end; minutes since the last "
        "commit count to it; default: when grading began",
    )
    add(
        "--processes",
        type=positive,
        default=os.cpu_count() or 1,
        metavar="N",
        help="submissions at a time; default: one per core",
    )
    add("--dask", metavar="ADDRESS", help="grade on this Dask scheduler's workers")
    add("--again", action="store_true", help="grade those too that did not change")
    add(
        "--i-know-them",
        action="store_true",
        help="grade with your own rights where no wall stands, or as root",
    )
    return parser.parse_args()


def moment(text: str) -> int:
    """Return a local time in seconds since 1970; a day alone means its end."""
    when = datetime.datetime.fromisoformat(text)
    if len(text) <= len("2026-09-04"):
        when += datetime.timedelta(days=1)
    return int(when.timestamp())


def positive(text: str) -> int:
    """Return a number of at least 1."""
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def in_container() -> bool:
    """Return whether this is a container, which is a wall of its own."""
    marks = ("/.dockerenv", "/run/.containerenv")
    return "container" in os.environ or any(Path(mark).exists() for mark in marks)


def admit(options: argparse.Namespace) -> None:
    """Say which wall stands, or refuse to run strangers' code without one."""
    if options.dask:
        print("wall: each worker's own")
        return
    stands, ways = wall(), "a container (docs/teaching.md), or add --i-know-them"
    print(f"wall: {stands.says}", flush=True)
    if options.i_know_them or in_container():
        return
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        raise Robo47Error(
            f"you are root, and this is no container: be an ordinary user, use {ways}"
        )
    if stands.name == "none":
        raise Robo47Error(f"these submissions would run with your rights: use {ways}")


def main() -> int:
    """Grade, write, and say in a few lines what came out."""
    options = parse()
    day = find_day(options.day)
    out = options.out or Path(f"grades-day{day.number}") / "grades.csv"
    students = find_students(options.root, options.roster)
    admit(options)
    with contextlib.suppress(FileExistsError):  # what is no folder is named below
        out.parent.mkdir(parents=True, exist_ok=True)
    given = options.deadline is not None
    journal = Journal(
        out.parent / "grading.jsonl",
        [day],
        options.deadline if given else int(time.time()),
        deadline=given,
    )
    room = Classroom(students, [day], journal, options.again)
    where = engine.dask(options.dask) if options.dask else None
    with contextlib.closing(journal), where or engine.local(options.processes) as it:
        if options.pull:
            room.pull()
        (course,) = room.grade(it, out.parent / "feedback")
        write_all(course, out)
    tell(room, course, out)
    return cli.EXIT_FAILED if room.notes or room.faults else cli.EXIT_OK


def tell(room: Classroom, course: Course, out: Path) -> None:
    """Print what came out."""
    states = [overview.state(graded) for graded in course.class_]
    order = ("done", "under way", "stuck", "does not load", "not started", "ungraded")
    counts = ", ".join(f"{states.count(s)} {s}" for s in order if s in states)
    print(f"Day {course.day.number}, {len(states):,} students: {counts}")
    kept = len(states) - room.graded_now - room.faults
    print(f"graded now: {room.graded_now:,}; unchanged since: {kept:,}")
    for one in overview.diagnoses(course.day, course.class_)[:3]:
        print(f"  {len(one.who):4}  {one.task}  {one.mistake}")
    if room.notes:
        print(f"not pulled: {len(room.notes):,}; the column error says why")
    if room.faults:
        print(f"this machine failed: {room.faults:,}; run the same command again")
    if "ungraded" in states:
        print("ungraded: the column error says why")
    journal = room.journal
    if journal.outdated:
        print(f"another version of the kit had graded: {journal.outdated:,}; done anew")
    if journal.odd:
        where = shown(journal.path.absolute())
        print(f"{where}: lines that are no result, left out: {journal.odd:,}")
    page = shown((out.parent / "class.html").absolute())
    print(f"wrote {shown(out.absolute())}, and feedback/ beside it; open {page}")


if __name__ == "__main__":
    cli.run(main)

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
Exit code: 0 everybody has a row, 1 somebody could not be pulled or was lost
with a worker, 2 could not run.
"""

import argparse
import contextlib
import datetime
import os
import time
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)

from robo47 import cli
from robo47.grading import engine, overview
from robo47.grading import kit as own_kit
from robo47.grading.classroom import Classroom, write_all
from robo47.grading.journal import Journal
from robo47.grading.roster import find_students
from robo47.grading.sheet import Graded
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
        help="minutes since last commit count to it; default: when grading began",
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
    return parser.parse_args()


def moment(text: str) -> int:
    """Return a time such as 2026-09-04T18:00, local, in seconds since 1970."""
    return int(datetime.datetime.fromisoformat(text).timestamp())


def positive(text: str) -> int:
    """Return a number of at least 1."""
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def main() -> int:
    """Grade, write, and say in a few lines what came out."""
    options = parse()
    day = find_day(options.day)
    out = options.out or Path(f"grades-day{day.number}") / "grades.csv"
    students = find_students(options.root, options.roster)
    with contextlib.suppress(FileExistsError):  # what is no folder is named below
        out.parent.mkdir(parents=True, exist_ok=True)
    given = options.deadline is not None
    journal = Journal(
        out.parent / "grading.jsonl",
        day.number,
        options.deadline if given else int(time.time()),
        deadline=given,
    )
    room = Classroom(students, day, journal, options.again)
    where = engine.dask(options.dask) if options.dask else None
    with contextlib.closing(journal), where or engine.local(options.processes) as it:
        if options.pull:
            room.pull()
        everybody, alike = room.grade(it, out.parent / "feedback")
    write_all(room, everybody, alike, out)
    tell(room, everybody, out)
    return cli.EXIT_FAILED if room.notes or room.lost else cli.EXIT_OK


def tell(room: Classroom, everybody: list[Graded], out: Path) -> None:
    """Print what came out."""
    states = [overview.state(graded) for graded in everybody]
    order = ("done", "under way", "stuck", "not started", "ungraded")
    counts = ", ".join(f"{states.count(s)} {s}" for s in order if s in states)
    print(f"Day {room.day.number}, {len(everybody):,} students: {counts}")
    kept = len(everybody) - room.graded_now - room.lost
    print(f"graded now: {room.graded_now:,}; unchanged since: {kept:,}")
    for one in overview.diagnoses(room.day, everybody)[:3]:
        print(f"  {len(one.who):4}  {one.task}  {one.mistake}")
    if room.notes:
        print(f"not pulled: {len(room.notes):,}; the column error says why")
    if room.lost:
        print(f"lost with their workers: {room.lost:,}; run the same command again")
    if room.journal.kits - {own_kit.fingerprint()}:
        print("some results are another version's of the kit; --again renews them")
    print(f"wrote {shown(out.absolute())}, and beside it class.html and feedback/")


if __name__ == "__main__":
    cli.run(main)

"""Grade a class: a folder with one clone per student, by this copy of the kit.

    python3 scripts/grade_class.py CLONES              (make grade ROOT=CLONES)
    python3 scripts/grade_class.py CLONES --day 1 --out grades-day1/grades.csv
    python3 scripts/grade_class.py CLONES --day 1-7    or --week 1, or --day all
    python3 scripts/grade_class.py CLONES --pull         update the clones first
    python3 scripts/grade_class.py CLONES --deadline 2026-09-04T18:00
    python3 scripts/grade_class.py CLONES --day 1-7 --proof    a page for each
    python3 scripts/grade_class.py CLONES --format canvas      or moodle
    python3 scripts/grade_class.py CLONES --dask tls://10.0.0.5:8786
    python3 scripts/grade_class.py CLONES --day 4 --hunt 1 --seed 7   a bug hunt

CLONES/roster.csv (name, folder, git) says who is in the class; without it,
each folder is a student. Beside the table: class.html (what to explain again,
who is stuck), feedback/ (a file per student) and grading.jsonl, in which each
result is kept as it comes: stop at any time, the same command goes on. Several
days: a folder for each as above, one table for a learning platform, one page.
Commit times are the students' own: the student's computer sets the clock.

Exit code: 0 everybody has a row, also those who are "ungraded" (the column
error says why), 1 somebody could not be pulled or this machine failed: run it
again, 2 could not run.
"""

import argparse
import contextlib
import datetime
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

from labkit.base import cli, git, processes, store
from labkit.base.text import count, visible
from labkit.grade import engine, hunts, hunts_page, page
from labkit.grade.classroom import Classroom, Regrading, pull, write_all
from labkit.grade.course import Course, percent
from labkit.grade.journal import Journal
from labkit.grade.package import version
from labkit.grade.roster import Student, find_students
from labkit.grade.sheet import (
    PLATFORMS,
    for_platform,
    known,
    of_days,
    table,
    write,
)
from labkit.hunt.mistakes import LEVELS
from labkit.lesson.day import Day, all_days, chosen_day, chosen_week, days_of, find_day
from labkit.sandbox.process import wall
from robo47.errors import Robo47Error
from robo47.paths import ROOT, menagerie_root, shown

KIT = ("--kit", "--ki")  # argparse accepts both spellings
# The limit of one proof; a whole week takes a minute on a quiet machine.
PROOF_SECONDS = 900.0
OF_KIT: dict[str, Any] = {"folder": ROOT, "seconds": 60}  # git's answers on this kit


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("root", type=Path, metavar="CLONES", help="folder with a clone per student")
    add("--day", metavar="N|N-M|all", help="default: the last that you worked on")
    add("--week", type=cli.week, metavar="N", help="all days of this week")
    where = "default: grades-dayN/grades.csv; of several days in grades-days/, of a "
    where += "week in grades-weekN/"
    add("--out", type=file, metavar="CSV", help=where)
    add("--roster", type=Path, metavar="CSV", help="default: CLONES/roster.csv")
    add("--pull", action="store_true", help="clone what is missing, update the rest")
    add(
        "--deadline",
        type=moment,
        metavar="TIME",
        help="2026-09-04T18:00, or a day, which means its end; minutes since the last "
        "commit count to it; default: when grading began",
    )
    add_how(parser)
    return parser.parse_args()


def add_how(parser: argparse.ArgumentParser) -> None:
    """Add how to grade, and what to write besides."""
    add = parser.add_argument
    cores = os.cpu_count() or 1
    at_once = "submissions at a time; default: one per core"
    add("--processes", type=positive, default=cores, metavar="N", help=at_once)
    drawn = "of the fresh inputs, the same for everybody; default: drawn once"
    add("--seed", type=int, metavar="N", help=drawn)
    hunted = "grade the bug hunt of --day, this level and --seed, its mistake's"
    add("--hunt", type=int, choices=sorted(LEVELS), metavar="LEVEL", help=hunted)
    asked = "of a hunt's fresh inputs, as --seed otherwise; default: drawn once"
    add("--inputs", type=int, metavar="N", help=asked)
    add("--dask", metavar="ADDRESS", help="grade on this Dask scheduler's workers")
    add("--proof", action="store_true", help="a page to show for each, of the week")
    whom = "grade those too that did not change: everybody, or only who asks"
    add("--again", nargs="?", const="", metavar="FOLDER,...", help=whom)
    counts = "which of somebody's results counts; default: last"
    add("--keep", choices=("best", "last"), default="last", help=counts)
    add("--kit", metavar="TAG", help="grade with the kit as it was at a tag or commit")
    add("--frozen", action="store_true", help="another version's results stay")
    imported = "write a table, canvas.csv, for a learning platform's import, too"
    add("--format", choices=("csv", *PLATFORMS), default="csv", help=imported)
    called = "what the platform calls it; default: Day {day}"
    add("--assignment", default="Day {day}", metavar="NAME", help=called)
    add("--anonymous", action="store_true", help="write a table without names, too")
    trusted = "grade with your own rights where no wall stands, or as root"
    add("--i-know-them", action="store_true", help=trusted)


def file(text: str) -> Path:
    """Return the path of a file; a folder is none."""
    if not Path(text).name:
        raise ValueError(text)
    return Path(text)


def moment(text: str) -> int:
    """Return a local time in seconds since 1970; a day alone means its end."""
    when = datetime.datetime.fromisoformat(text)
    try:
        if len(text) <= len("2026-09-04"):
            when += datetime.timedelta(days=1)
        return int(when.timestamp())
    except OverflowError:  # the end of the last year there is
        raise ValueError(text) from None


def positive(text: str) -> int:
    """Return a number of at least 1."""
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def admit(options: argparse.Namespace) -> None:
    """Say which wall stands, or refuse to run strangers' code without one."""
    says = "each worker's own; without one it refuses" if options.dask else wall().says
    print(cli.wrapped(f"wall: {says}", "  "), flush=True)
    why = "" if options.dask or options.i_know_them else engine.refusal()
    if why:
        raise Robo47Error(
            f"{why}, use a container (docs/teaching.md), or add --i-know-them"
        )


def chosen(text: str | None, week: int | None = None) -> list[Day]:
    """Return the days that "2", "1-7" or "all" means, or a week.

    Without either, the day that was worked on last, which is printed.

    Raises:
        Robo47Error: it means none, or both are given.
    """
    if week is not None:
        if text:
            raise Robo47Error("--day and --week: name one of the two")
        return days_of(chosen_week(week))
    if not text:
        day = chosen_day(None)
        print(
            f"grading Day {day.number}: you worked on it last, or on no day yet;\n"
            "  DAY=2, DAY=1-7, DAY=all or WEEK=1 selects others"
        )
        return [day]
    if text == "all":
        return all_days()
    span = re.fullmatch(r"(\d+)(?:-(\d+))?", text)
    if not span:
        raise Robo47Error(f"--day {text}: expected a day (2), days (1-7), or all")
    if not span[2]:
        return [find_day(int(text))]
    first, last = int(span[1]), int(span[2])
    found = [day for day in all_days() if first <= day.number <= last]
    if not found:
        raise Robo47Error(f"the kit has none of the days {first} to {last}")
    return found


def folder_of(days: list[Day], week: int | None) -> str:
    """Return where the grades of these days are written, if nobody says where.

    Args:
        days: that are graded.
        week: its number, where a whole week was asked for: each has a folder, so that
            the grades of one are not written over by those of another.
    """
    if week is not None:
        return f"grades-week{week}"
    return "grades-days" if len(days) > 1 else f"grades-day{days[0].number}"


def main() -> int:
    """Grade, write, and say in a few lines what came out."""
    options = parse()
    if options.kit:
        return with_kit(options.kit)
    if options.hunt:
        return grade_hunt(options)
    days = chosen(options.day, options.week)
    several = len(days) > 1
    out = options.out or Path(folder_of(days, options.week)) / "grades.csv"
    students = find_students(options.root, options.roster)
    platform = PLATFORMS.get(options.format)
    if platform:
        known(platform, students)
    admit(options)
    courses, notes = grade_days(days, students, out, options)
    if several:
        write(out, of_days(courses))
        write(out.parent / "class.html", page.render_days(courses).encode("utf-8"))
    if platform:
        own = out.with_name(f"{options.format}.csv")
        write(own, for_platform(platform, courses, options.assignment))
        print(f"wrote {shown(own.absolute())}: import it into {platform.name}")
    if options.proof:
        numbers = sorted({day.week.number for day in days})
        for week in numbers:
            place = out.parent / "proof"
            place = place / f"week{week}" if len(numbers) > 1 else place
            prove(students, week, place, options.processes, courses)
    failed = tell(courses, notes, out)
    return cli.EXIT_FAILED if failed else cli.EXIT_OK


def grade_hunt(options: argparse.Namespace) -> int:
    """Grade a class's bug hunt; write its table and its page."""
    (day, *others) = chosen(options.day, options.week)
    if others or options.seed is None:
        raise Robo47Error("which hunt? --day 4 --hunt 1 --seed 7")
    if options.dask:
        raise Robo47Error("a hunt is graded on this machine: leave --dask out")
    hunt = hunts.Hunt(day, options.hunt, options.seed)
    hunt.case  # noqa: B018 (says at once that there is nothing to hunt)
    students = find_students(options.root, options.roster)
    admit(options)
    folder = f"hunt-day{day.number}-level{hunt.level}-seed{hunt.seed}"
    out = options.out or Path(folder) / "hunt.csv"
    hunters, notes = hunt_all(hunt, students, out, options)
    write(out, table(hunts.columns(hunters)))
    page = out.with_suffix(".html")
    write(page, hunts_page.render(hunt, hunters).encode("utf-8"))
    print(f"Day {day.number}, level {hunt.level}, seed {hunt.seed}")
    print(cli.wrapped(hunts.standings(hunters), "  "))
    if odd := sum(bool(one.odd) for one in hunters):
        print(f"contradicts the script: {odd:,}; the page says what")
    for folder, note in notes.items():
        print(cli.wrapped(f"{folder}: {note}", "  "))
    faults = sum(one.fault for one in hunters)
    if faults:
        print(f"this machine failed: {faults:,}; run the same command again")
    print(f"wrote {shown(out.absolute())}; open {shown(page.absolute())}")
    return cli.EXIT_FAILED if notes or faults else cli.EXIT_OK


def hunt_all(
    hunt: hunts.Hunt, students: list[Student], out: Path, options: argparse.Namespace
) -> tuple[list[hunts.Hunter], dict[str, str]]:
    """Return how everybody's hunt stands, and who could not be pulled, and why.

    Each result is kept in a journal beside the table as it comes, with the seed of the
    fresh inputs: the same command goes on where it was stopped.
    """
    path = out.parent / "hunting.jsonl"
    with contextlib.suppress(FileExistsError, FileNotFoundError):
        path.parent.mkdir(parents=True, exist_ok=True)
    journal = hunts.HuntJournal(path, hunt, options.deadline, options.inputs)
    with contextlib.closing(journal), engine.local(options.processes) as it:
        print(f"kit: {version()}; fresh inputs for everybody: --inputs {journal.seed}")
        notes = pull(students) if options.pull else {}
        return list(hunts.grade(hunt, students, it, journal)), notes


def with_kit(tag: str) -> int:
    """Run the same command with the kit as it was at a tag; return its exit code."""
    folder = kit_at(tag)
    words = sys.argv[1:]
    at = next(i for i, word in enumerate(words) if word.partition("=")[0] in KIT)
    del words[at : at + (1 if "=" in words[at] else 2)]
    command = [sys.executable, str(folder / "scripts" / "grade_class.py"), *words]
    places = {"PYTHONPATH": str(folder), "MENAGERIE_ROOT": str(menagerie_root())}
    return subprocess.call([*command, "--frozen"], env={**os.environ, **places})


def kit_at(tag: str) -> Path:
    """Return a folder with the kit as it was at a tag, made where it is not there.

    Raises:
        Robo47Error: there is no such commit, or git cannot write it.
    """
    found = git.run("rev-parse", "-q", "--verify", f"{tag}^{{commit}}", **OF_KIT)
    commit = found.stdout.strip()
    folder = store.path_of("kits") / commit[:12]
    if found.returncode or not commit:
        raise Robo47Error(f"the kit has no tag {tag}; those it has: git tag")
    if not (folder / ".git").exists():
        add = ("worktree", "add", "-q", "-f", "--detach", str(folder), commit)
        git.run("worktree", "prune", **OF_KIT)
        git.run(*add, **OF_KIT)
    # whole, also where a run was killed amid it
    made = git.run("reset", "-q", "--hard", commit, folder=folder, seconds=60)
    if made.returncode:
        raise Robo47Error(f"the kit at {tag} cannot be written: {made.stderr}")
    return folder


def again_of(text: str | None) -> Regrading:
    """Return whom `--again` means: nobody without it, everybody where it stands alone.

    Args:
        text: None without it, "" where it stands alone, folders with commas between.
    """
    if text is None:
        return Regrading()
    return Regrading(folders=text.split(",")) if text else Regrading(everybody=True)


def grade_days(
    days: list[Day], students: list[Student], out: Path, options: argparse.Namespace
) -> tuple[list[Course], dict[str, str]]:
    """Grade each day: its table, its page, the students' files; say how it went.

    Args:
        days: one after the other: a week takes the memory of a day.
        students: from the roster.
        out: the table; of several days that of all, with a folder for each beside it.
        options: the command line.

    Returns:
        The days, and who could not be pulled, and why, by folder.
    """
    courses = list[Course]()
    notes = dict[str, str]()
    again = again_of(options.again)
    where = engine.dask(options.dask, options.i_know_them) if options.dask else None
    with where or engine.local(options.processes) as it:
        for day in days:
            folder = out.parent / f"day{day.number}"
            own = folder / "grades.csv" if len(days) > 1 else out
            # The journal names a path that is no folder.
            with contextlib.suppress(FileExistsError, FileNotFoundError):
                own.parent.mkdir(parents=True, exist_ok=True)
            path = own.parent / "grading.jsonl"
            journal = Journal(path, day, options.deadline, options.seed)
            with contextlib.closing(journal):
                if not courses:
                    options.seed = journal.seed  # one for all days
                    drawn = f"fresh inputs for everybody: --seed {journal.seed}"
                    print(f"kit: {version()}; {drawn}")
                    notes = pull(students) if options.pull else {}
                room = Classroom(
                    students,
                    day,
                    journal,
                    again=again,
                    frozen=options.frozen,
                    keep=options.keep,
                    notes=notes,
                )
                course = room.grade(it, own.parent / "feedback")
                write_all(course, own, anonymous=options.anonymous)
            print(f"Day {day.number}, {standings(course)}", flush=True)
            courses.append(course)
    return courses, notes


def standings(course: Course) -> str:
    """Return how many students a day has, and how many are in each state."""
    number = course.counts
    words = [f"{number[state]} {state}" for state in page.ROLES if number[state]]
    return f"{count(len(course.class_), 'student')}: {', '.join(words)}"


def prove(
    students: list[Student],
    week: int,
    folder: Path,
    at_once: int,
    courses: Sequence[Course] = (),
) -> None:
    """Write each student's page to show; say who has none, and why.

    Args:
        students: from the roster.
        week: its number.
        folder: where the pages go.
        at_once: how many are made at a time.
        courses: the days that were graded: a page shows the commits that were.
    """
    folder.mkdir(parents=True, exist_ok=True)
    graded: dict[str, list[str]] = {student.folder: [] for student in students}
    for course in courses:
        for one in course.class_:
            if course.day.week.number == week and one.commit:
                graded[one.student.folder].append(f"{course.day.number}:{one.commit}")
    with ThreadPoolExecutor(at_once) as pool:
        write = partial(write_proof, week, folder)
        whys = list(pool.map(write, students, graded.values()))
    without = [both for both in zip(students, whys, strict=True) if both[1]]
    print(f"pages to show: {len(students) - len(without):,} in {shown(folder)}")
    for student, why in without:
        print(cli.wrapped(f"{student.name}: {why}", "  "))


def write_proof(week: int, folder: Path, student: Student, graded: list[str]) -> str:
    """Write a student's page in a process of its own; return why there is none."""
    if student.problem:
        return student.problem
    command = [sys.executable, str(ROOT / "scripts" / "proof.py"), "--week", str(week)]
    command += ["--of", str(student.path), f"--name={student.name}"]
    command += ["--out", str(folder / f"{student.file}.html")]
    command += ["--graded", ",".join(graded)] if graded else []
    promised = {**os.environ, "ROBO47_WALL": wall().name}
    try:
        done = processes.run(command, env=promised, timeout=PROOF_SECONDS)
    except subprocess.TimeoutExpired:
        return f"it took more than {PROOF_SECONDS:.0f} s"
    return visible(done.stderr.strip().rpartition("\n")[2]) if done.returncode else ""


def tell(courses: list[Course], notes: dict[str, str], out: Path) -> bool:
    """Print what came out of all days; return whether something failed."""
    graded = [one for course in courses for one in course.class_]
    faults = sum(one.fault for one in graded)
    now = sum(course.graded_now for course in courses)
    print(f"graded now: {now:,}; unchanged since: {len(graded) - now - faults:,}")
    several = len(courses) > 1  # then the page has them, day by day
    for mark, who in [] if several else courses[0].mistakes()[: page.COMMON]:
        print(f"  {len(who):4}  {mark.id}  {mark.mistake}")
    if notes:
        print(f"not pulled: {len(notes):,}; the column error says why")
    if faults:
        print(f"this machine failed: {faults:,}; run the same command again")
    if not all(map(percent, graded)):
        print("ungraded: the column error says why")
    if outdated := sum(course.outdated for course in courses):
        print(f"graded with another version of the kit, so graded again: {outdated:,}")
    for course in courses:
        if course.odd:
            print(course.odd)
    class_page = shown((out.parent / "class.html").absolute())
    beside = "a folder for each day" if several else "feedback/"
    print(f"wrote {shown(out.absolute())}, and {beside} beside it; open {class_page}")
    return bool(notes or faults)

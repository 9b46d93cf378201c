"""Write a results page to show: a week's numbers and functions, its capstone in 3D.

    make proof                            of your week: metrics/proof-week1.html
    make proof WEEK=1                     of this week
    make proof ARGS="--out week1.html"    somewhere else
    python3 scripts/proof.py --of CLONE --name NAME --out FILE
                                          of a student's clone, for a teacher

The command checks every function, runs every finished lab again in the sandbox, and
runs the week's capstone with the functions that pass. The page is one file, which you
open from disk; metrics/proof.html links the pages of all weeks. Next to your own page
is its card, proof-week1.png. If you put both on a server, a shared link to the page
shows the card.
"""

import contextlib
import importlib.util
import io
import re
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

from labkit.base import cli, git, store
from labkit.base.git import GitError, read_history
from labkit.base.text import visible
from labkit.check.own_functions import capstone_of
from labkit.fresh import FRESH
from labkit.grade.roster import Student
from labkit.lesson.day import Day, chosen_week, days_of, find_day
from labkit.lesson.student_files import OWN_LABS
from labkit.lesson.week import Week
from labkit.proof import door, page
from labkit.proof.capstone import NO_CAPSTONE, attempt
from labkit.proof.facts import RunDay, facts_of
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, ROOT, shown


def main() -> int:
    """Find everything out, write the page, say where it is."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("--week", type=cli.week, help="default: that of the day worked on last")
    add("--day", type=cli.day, metavar="N", help="the week of this day")
    add("--of", type=Path, metavar="CLONE", help="a student's clone, not your own")
    add("--name", default="", help="to show; default: the name that git knows")
    add("--graded", type=graded, default={}, metavar="N:COMMIT,...", help="of each day")
    add("--out", type=Path, metavar="FILE", help="default: metrics/proof-weekN.html")
    options = parser.parse_args()
    if importlib.util.find_spec("viser") is None:
        raise Robo47Error(
            "the film needs viser, which is not installed yet: make proof"
        )
    week = chosen_week(options.week, options.day)
    out = options.out or METRICS_CSV.with_name(door.PAGE.format(week.number))
    if not out.parent.is_dir():
        folder = shown(out.parent.absolute())
        raise Robo47Error(f"{folder} is no folder; choose another place with --out")
    begun = time.monotonic()
    try:
        clone, own = options.of or ROOT, not options.of
        name = options.name or (asked_name(clone) if own else "")
        proof = found(week, clone, name, own=own, graded=options.graded)
    except (OSError, GitError) as error:
        raise Robo47Error(f"{error}") from None
    facts = page.in_short(proof)
    shared = draw_card(out.with_suffix(".png"), proof) if own else None
    text = page.render(proof, shared.name if shared else "")
    write(out, door.with_facts(text, facts).encode("utf-8", "replace"))
    size = out.stat().st_size / 1e6
    print(f"wrote {shown(out.absolute())}: {size:.1f} MB, one file to open or")
    print(f"send, in {time.monotonic() - begun:.0f} s; it says what it does not prove")
    if shared:
        print(f"wrote {shown(shared.absolute())}: its card, for where you share it")
    if options.out is None:
        every = METRICS_CSV.with_name("proof.html")
        write(every, door.render(door.pages_beside(every.parent)).encode())
        print(f"wrote {shown(every.absolute())}, which leads to the pages of all weeks")
    return cli.EXIT_OK


def asked_name(clone: Path) -> str:
    """Return the name that the student types where git has none; "" for no name.

    Without a keyboard nothing is asked, and the page is made without a name.
    """
    if git.user_name(clone):
        return ""  # `found` reads it
    if sys.stdin is not None and sys.stdin.isatty():
        print("git does not know your name. Which name should the page show?")
        with contextlib.suppress(EOFError):
            return input("Your name, or Enter for a page without one: ").strip()
    says = 'The page shows no name, because git has none: make proof ARGS="--name Ada",'
    print(cli.wrapped(f'{says} or git config --global user.name "Your Name"'))
    return ""


def draw_card(path: Path, proof: page.Proof) -> Path:
    """Write the picture to share; return where it is."""
    from labkit.proof import card  # Pillow comes with viser

    with cli.busy("its card"):
        picture = io.BytesIO()
        card.draw(page.in_short(proof), proof.attempt).save(picture, "PNG")
    write(path, picture.getvalue())
    return path


def graded(text: str) -> dict[int, str]:
    """Return the commit of each day of "1:360fd61...,2:360fd61..."."""
    found = dict[int, str]()
    for number, _, commit in (pair.partition(":") for pair in text.split(",")):
        if not re.fullmatch("[0-9a-f]{7,64}", commit):
            raise ValueError(text)
        found[int(number)] = commit
    return found


def found(
    week: Week,
    clone: Path,
    name: str = "",
    *,
    own: bool = False,
    graded: Mapping[int, str] = MappingProxyType({}),
) -> page.Proof:
    """Check a week's days in somebody's clone, run its labs and the capstone.

    Args:
        week: from its manifest.
        clone: the folder.
        name: the student's; by default as git knows them: by user.name in their own
            clone, by the author of the last commit of their work in another. The page
            of a student without any name shows none.
        own: it is the reader's, which may be a linked worktree.
        graded: the commit of each day that was; of others the last of these.
    """
    days = days_of(week)
    history = read_history(clone, (), own=own)
    name = name or (git.user_name(clone) if own else git.author_of(clone, OWN_LABS))
    name = visible(name, 80)
    student = Student(name, clone.name, clone)
    with Sandbox() as sandbox, TemporaryDirectory(prefix="robo47-grade-") as top:
        place = Path(top).resolve()
        known = list(run_days(days, student, place, sandbox, own, graded))
        if all("not begun" in one.states.values() for one in known):
            raise Robo47Error("nothing is begun that could be shown: make start DAY=1")
        tried = NO_CAPSTONE
        if week.capstone:
            capstone = capstone_of(week)
            # It may stand on the functions of other weeks as well.
            others = [find_day(n) for n in capstone.USES if n not in week.days]
            whole = [*known, *run_days(others, student, place, sandbox, own, graded)]
            folders = [place / str(one.day.number) for one in whole]
            with cli.busy(capstone.NAME):
                tried = attempt(capstone, whole, folders, sandbox)
    fresh = store.read(FRESH) if own else {}
    ran = dict.fromkeys(one.commit for one in known if one.commit and not own)
    commit = ", ".join(ran) or history.commit
    return page.Proof(name, own, commit, known, tried, fresh)


def run_days(
    days: Sequence[Day],
    student: Student,
    place: Path,
    sandbox: Sandbox,
    own: bool,
    graded: Mapping[int, str],
) -> Iterator[RunDay]:
    """Yield how each day stands; its files stay in a folder of its number.

    Args:
        days: to check and to run.
        student: whose.
        place: an empty folder, in which each day gets one.
        sandbox: where the functions run.
        own: it is the reader's own clone.
        graded: the commits, as those of `found`.
    """
    last = ([*graded.values()] or [""])[-1]
    for day in days:
        folder = place / str(day.number)
        folder.mkdir()
        with cli.busy(f"day {day.number}"):
            at = graded.get(day.number, last)
            found = facts_of(day, student, folder, sandbox, own=own, at=at)
        theirs = f"{len(found.own)} of {found.functions} functions by the student"
        print(f"  day {day.number}: {theirs}", flush=True)
        yield found


def write(path: Path, content: bytes) -> None:
    """Write a file whole."""
    try:
        store.replace(path, content)
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path.absolute())}: {error.strerror or error}."
            " Choose another place with --out."
        ) from None

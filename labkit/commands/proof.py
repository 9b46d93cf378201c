"""Write a page to show: a week's numbers, whose functions, the pick in 3D.

    make proof                            metrics/proof.html, of your week
    make proof ARGS="--out week1.html"    somewhere else
    python3 scripts/proof.py --of CLONE --name NAME --out FILE
                                          of a student's clone, for a teacher

Every function is checked and every finished lab is run again now, in the sandbox; the
arm picks the cube up with the functions that pass. One file, opened from disk.
"""

import importlib.util
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from labkit.base import cli, store
from labkit.base.git import GitError, read_history
from labkit.base.text import visible
from labkit.fresh import FRESH
from labkit.grade.roster import Student
from labkit.lesson.day import chosen_week, days_of
from labkit.lesson.week import Week
from labkit.proof import page
from labkit.proof.facts import RunDay, facts_of
from labkit.proof.pick import pick
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, ROOT, shown


def main() -> int:
    """Find everything out, write the page, say where it is."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("--week", type=int, help="default: the one begun last")
    add("--of", type=Path, metavar="CLONE", help="a student's clone, not your own")
    add("--name", default="", help="the student's; default: the last commit's author")
    add("--out", type=Path, default=METRICS_CSV.with_name("proof.html"), metavar="FILE")
    options = parser.parse_args()
    if importlib.util.find_spec("viser") is None:
        raise Robo47Error(
            "the film needs viser, which is not installed yet: make proof"
        )
    if not options.out.parent.is_dir():
        folder = shown(options.out.parent.absolute())
        raise Robo47Error(f"{folder} is no folder; choose another place with --out")
    begun = time.monotonic()
    week = chosen_week(options.week)
    try:
        proof = found(week, options.of or ROOT, options.name, own=not options.of)
    except (OSError, GitError) as error:
        raise Robo47Error(f"{error}") from None
    write(options.out, page.render(proof))
    size = options.out.stat().st_size / 1e6
    print(f"wrote {shown(options.out.absolute())}: {size:.1f} MB, one file to open or")
    print(f"send, in {time.monotonic() - begun:.0f} s; it says what it does not prove")
    return cli.EXIT_OK


def found(week: Week, clone: Path, name: str = "", *, own: bool = False) -> page.Proof:
    """Check a week's days in somebody's clone, run its labs and the capstone.

    Args:
        week: from its manifest.
        clone: the folder.
        name: the student's; by default the last commit's author.
        own: it is the reader's, which may be a linked worktree.
    """
    days = days_of(week)
    history = read_history(clone, (), own=own)
    name = visible(name or history.author, 80) or "somebody whom git does not know"
    student = Student(name, clone.name, clone)
    with Sandbox() as sandbox, TemporaryDirectory(prefix="robo47-grade-") as top:
        folders = [Path(top).resolve() / str(day.number) for day in days]
        known: list[RunDay] = []
        for day, folder in zip(days, folders, strict=True):
            folder.mkdir()
            with cli.busy(f"day {day.number}"):
                known.append(facts_of(day, student, folder, sandbox, own=own))
            theirs = f"{len(known[-1].own)} of {known[-1].functions} functions theirs"
            print(f"  day {day.number}: {theirs}", flush=True)
        if all("not begun" in one.states.values() for one in known):
            raise Robo47Error("nothing is begun that could be shown: make start DAY=1")
        with cli.busy("the pick"):
            picked = pick(known, folders, sandbox)
    fresh = store.read(FRESH) if own else {}
    return page.Proof(name, own, history.commit, known, picked, fresh)


def write(path: Path, text: str) -> None:
    """Write the page whole."""
    try:
        store.replace(path, text.encode("utf-8", "replace"))
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path.absolute())}: {error.strerror or error}."
            " Choose another place with --out."
        ) from None

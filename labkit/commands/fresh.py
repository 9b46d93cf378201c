"""Test whether a clone of your last commit reproduces your numbers.

    python3 scripts/fresh.py             your current week (make fresh)
    python3 scripts/fresh.py 2           week 2
    python3 scripts/fresh.py --quick     in this environment, no set-up

The command clones the commit, not your folder, into a temporary folder, sets it up from
nothing and runs the labs of the week: yours, or the kit's for days that you have not
begun. It compares their numbers with the rows that you committed, and lists missing
files. It adds no row to the log.
Exit code: 0 the same numbers, 1 something to fix, 2 could not run.
"""

import datetime
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path

from labkit.base import cli, store
from labkit.base.processes import sweep
from labkit.base.text import count
from labkit.fresh import FRESH
from labkit.fresh.clone import clone_commit, head_of, set_up
from labkit.fresh.compare import faults
from labkit.fresh.missing import findings, unwritten
from labkit.lesson.day import chosen_week, days_of
from labkit.lesson.week import find_week
from labkit.report.week_labs import LabResult, run_labs
from robo47.paths import ROOT, shown

FOLDER = "robo47-fresh-"
LEFT_BEHIND = 3600  # seconds; a run takes some minutes


def progress(begun: float, what: str) -> None:
    """Print a line of progress, with the seconds since it began."""
    print(f"{time.monotonic() - begun:5.1f} s  {what}", flush=True)


def compared(
    running: Iterable[LabResult], clone: Path, say: Callable[[str], None]
) -> tuple[list[LabResult], list[str]]:
    """Return what became of the labs in the clone, and what is not right."""
    labs, wrong = [], []
    for ran in running:
        found = faults(ran, clone)
        whose = "your lab" if ran.mine else "the kit's lab"
        say(f"{cli.verdict(not found)}  day {ran.day.number}, {whose}")
        labs.append(ran)
        wrong += found
    return labs, wrong


def verdict(labs: Sequence[LabResult], wrong: Sequence[str]) -> int:
    """Print what is to be fixed, and one clear line; return the exit code."""
    for line in wrong:
        print(cli.wrapped(f"  - {line}", "    "))
    if wrong:
        thing = count(len(wrong), "thing")
        return cli.conclude(False, f"{thing} to fix; commit, then: make fresh")
    rows = count(sum(len(ran.day.metrics) for ran in labs if ran.mine), "row")
    ran = count(len(labs), "lab")
    if any(one.mine for one in labs):
        says = f"a clone of your last commit gives your numbers: {ran}, {rows}"
    else:
        says = f"a clone runs: {ran}, the kit's own; there are no rows to compare"
    return cli.conclude(True, says)


def main() -> int:
    """Clone, set up, run, compare."""
    parser = cli.parser(__doc__)
    cli.add_week(parser)
    quick = "no environment of its own"
    parser.add_argument("--quick", action="store_true", help=quick)
    options = parser.parse_args()
    week = chosen_week(options.week, options.day)
    sha = head_of()
    say = partial(progress, time.monotonic())
    sweep(FOLDER, LEFT_BEHIND)
    with tempfile.TemporaryDirectory(
        prefix=FOLDER, ignore_cleanup_errors=True
    ) as folder:
        root = Path(folder).resolve() / "clone"
        clone_commit(sha, root)
        days = days_of(find_week(week.number, root))
        missing = findings(days, root)
        say(f"cloned {sha[:7]}")
        if not options.quick:
            say("setting it up from nothing, as somebody else would")
        python, environment = set_up(root, say, anew=not options.quick)
        say("set up" + (" with this environment" if options.quick else ""))
        labs, wrong = compared(run_labs(days, python, environment), root, say)
        blank = unwritten(days, ROOT)  # it reads the manifests of the clone
    code = verdict(labs, [*missing, *wrong])
    for diary in blank:
        says = f"{shown(diary)} asks what this found: write it there, and commit."
        print(cli.wrapped(f"  Not yet written: {says}", "  "))
    found = {"wrong": len(wrong), "missing": len(missing)}
    when = datetime.date.today().isoformat()  # `make proof` shows it for this commit
    store.write(FRESH, {**found, "commit": sha, "date": when})
    return code

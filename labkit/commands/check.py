"""Check a day: which tasks and deliverables pass, and what is wrong with the others.

    python3 scripts/check_day.py 1              the whole day (make check DAY=1)
    python3 scripts/check_day.py --task 1.4     one task (make check TASK=1.4)
    python3 scripts/check_day.py 1 --watch      make watch: at each save
    python3 scripts/check_day.py 1 --explain    with all measurements
    python3 scripts/check_day.py 1 --json       as JSON, for tools

Your code runs in a process of its own, on a copy, and changes none of your files.
Exit code: 0 all passed, 1 something to fix, 2 the checker could not run, 70 the kit
itself failed. With make, "something to fix" is no error, and the other codes are.
"""

import argparse
import atexit
import gc
import json
import os
import secrets
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from labkit.base import cli
from labkit.base.git import short_sha
from labkit.commands.start import require_begun
from labkit.lesson.day import Day, chosen_day
from robo47 import __version__
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

if TYPE_CHECKING:
    from labkit.check.report import Report


def parse(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line, or what is given instead."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=cli.day, nargs="?", help="default: the one worked on last"
    )
    parser.add_argument("--task", help="check this task alone, such as 1.4")
    parser.add_argument("--file", type=Path, help="instead of the file in work/")
    parser.add_argument("--watch", action="store_true", help="check again at each save")
    parser.add_argument("--explain", action="store_true", help="show measurements")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "--seed", type=int, metavar="N", help="of the sampled inputs; default: random"
    )
    return parser.parse_args(arguments)


def check(day: Day, options: argparse.Namespace) -> int:
    """Check once, print the report and return the exit code."""
    seed = secrets.randbits(32) if options.seed is None else options.seed
    found = report_of(day, options, seed)
    print(_printed(found, options, seed))
    return cli.EXIT_OK if found.passed else cli.EXIT_FAILED


def report_of(day: Day, options: argparse.Namespace, seed: int) -> "Report":
    """Check once and return the report.

    Args:
        day: from its manifest.
        options: as `parse` returns them.
        seed: of the inputs that are drawn anew.

    Raises:
        Robo47Error: the day is not begun, or the file that is named is not there.
    """
    script = options.file or day.work
    if not options.file:
        require_begun(day)
    elif not script.is_file():
        raise Robo47Error(f"{shown(script)} is not there")
    from labkit.check.once import check_once

    return check_once(day, script, options.task, seed)


def _printed(found: "Report", options: argparse.Namespace, seed: int) -> str:
    """Return a report as it was asked for: for people, or for tools."""
    from labkit.check.report import as_json, as_text

    if options.json:
        made = {"kit": __version__, "commit": short_sha(ROOT), "seed": seed}
        return json.dumps(as_json(found) | made, indent=1)
    colour = cli.wants_colour(sys.stdout)
    return as_text(found, explain=options.explain, colour=colour)


def main() -> int:
    """Check a day, once or at every save."""
    os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn: no window library
    atexit.register(gc.freeze)  # nor are NumPy and MuJoCo looked through once more
    options = parse()
    day = chosen_day(options.day, options.task)
    if not options.watch:
        return check(day, options)
    from labkit.commands.watch import watch

    if not options.file:
        require_begun(day)
    return watch(day, options.task, options.file)

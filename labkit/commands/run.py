"""Run a day's lab: your copy, or the kit's.

    python3 scripts/run_day.py            your copy of the last day you began
    python3 scripts/run_day.py 1          of day 1 (make run DAY=1)
    python3 scripts/run_day.py 1 --kit    the kit's own, complete (make day1)

Other options, such as --no-log, are passed to the lab. A number that the day's
worksheet asks you to predict is hidden until you have written your prediction. To see
all numbers: make run DAY=1 ARGS=--reveal
"""

import os
import subprocess
import sys

from labkit.base import cli
from labkit.commands.start import require_begun
from labkit.lesson.day import chosen_day
from labkit.lesson.starter import require_kits


def main() -> int:
    """Find the lab by its manifest and go on in it."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=cli.day, nargs="?", help="default: the one worked on last"
    )
    parser.add_argument("--kit", action="store_true", help="the kit's, not yours")
    options, others = parser.parse_known_args()
    day = chosen_day(options.day)
    if options.kit:
        require_kits(day)
    else:
        require_begun(day)
    lab = [str(day.source), "--predict-first"] if options.kit else [str(day.work)]
    command = [sys.executable, *lab, *others]
    sys.stdout.flush()
    if os.name == "nt":  # execv there returns to the shell before the script has ended
        return subprocess.run(command, check=False).returncode
    cli.go_on_in(command)

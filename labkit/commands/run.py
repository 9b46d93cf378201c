"""Run a day's lab: your own copy of it, or the kit's.

    python3 scripts/run_day.py            your copy of the last day you began
    python3 scripts/run_day.py 1          of day 1 (make run DAY=1)
    python3 scripts/run_day.py 1 --kit    the kit's own, complete (make day1)

Other options go to the lab, such as --no-log.
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
    command = [sys.executable, str(day.source if options.kit else day.work), *others]
    sys.stdout.flush()
    if os.name == "nt":  # execv there returns to the shell before the script has ended
        return subprocess.run(command, check=False).returncode
    os.execv(command[0], command)

"""Run a day's lab: your copy, or the kit's.

    python3 scripts/run_day.py            your copy of the last day you began
    python3 scripts/run_day.py 1          of day 1 (make run DAY=1)
    python3 scripts/run_day.py 1 --kit    the kit's own, complete (make day1)

Other options, such as --no-log, are passed to the lab. While the day's worksheet still
lacks predictions, the kit's lab prints its verdicts without the numbers; --numbers
prints the numbers anyway.
"""

import os
import re
import subprocess
import sys

from labkit.base import cli, processes
from labkit.base.text import count
from labkit.commands.start import require_begun
from labkit.lesson.day import Day, chosen_day
from labkit.lesson.predicted import rows_asked
from labkit.lesson.starter import require_kits
from robo47.paths import shown

# A line of a lab: a verdict, up to its number, or anything else that is indented.
_VERDICT = re.compile(r"(  PASS  .*): \S+ \(.+\)")


def waiting(day: Day) -> int:
    """Return how many predictions a day's worksheet still waits for."""
    try:
        sheet = (day.folder / day.worksheet).read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError):
        return 0
    return list(rows_asked(sheet).values()).count("")


def without_numbers(line: str) -> str | None:
    """Return what a line of a lab says but its number; None where nothing is left."""
    if found := _VERDICT.fullmatch(line):
        return found[1]
    return None if line.startswith("  ") and "FAIL" not in line else line


def run_quietly(command: list[str], day: Day, number: int) -> int:
    """Run a lab whose numbers are still to be predicted; return its exit code."""

    def say(line: str) -> None:
        told = without_numbers(line)
        if told is not None:
            print(told, flush=True)

    code, printed = processes.run_and_tell(command, say)
    if code:
        print(printed)  # what is wrong, in full
        return code
    says = f"Its numbers are not shown yet: {count(number, 'prediction')} of yours go "
    says += f"first, into {shown(day.folder / day.worksheet)}. To see them now: "
    print(cli.wrapped(f"{says}make day{day.number} ARGS=--numbers"))
    return code


def main() -> int:
    """Find the lab by its manifest and go on in it."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=cli.day, nargs="?", help="default: the one worked on last"
    )
    parser.add_argument("--kit", action="store_true", help="the kit's, not yours")
    parser.add_argument(
        "--numbers", action="store_true", help="of the kit's lab, also before yours"
    )
    options, others = parser.parse_known_args()
    day = chosen_day(options.day)
    if options.kit:
        require_kits(day)
    else:
        require_begun(day)
    command = [sys.executable, str(day.source if options.kit else day.work), *others]
    sys.stdout.flush()
    if options.kit and not options.numbers and (number := waiting(day)):
        return run_quietly(command, day, number)
    if os.name == "nt":  # execv there returns to the shell before the script has ended
        return subprocess.run(command, check=False).returncode
    cli.go_on_in(command)

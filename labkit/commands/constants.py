"""Sensitivity of a guide's numbers: double each constant and measure the effect.

    make constants DAY=8                    the table in its guide
    python3 scripts/constants.py 8          the same
    python3 scripts/constants.py 8 --check  only the faults

The list is `constants.py` in the day's folder: the numbers, the constants that each of
them could depend on, and the expected effect of doubling with its reason. If a number
does something else, the reason is wrong, in the list or in the guide, and the command
fails and names it. `make docs` inserts the table into the guide.

Exit code: 0 all as expected, 1 another effect, 2 could not run.
"""

import sys

from labkit.base import cli
from labkit.lesson.constants import faults, numbers_of, table, unprinted
from labkit.lesson.day import chosen_day


def main() -> int:
    """Double the constants of a day."""
    parser = cli.parser(__doc__)
    parser.add_argument("day", type=cli.day, nargs="?", help="default: the last one")
    parser.add_argument("--check", action="store_true", help="print faults alone")
    options = parser.parse_args()
    day = chosen_day(options.day)
    found = list(numbers_of(day).measured())
    wrong = list(faults(found))
    if options.check:
        wrong += unprinted(found, day)
    else:
        print(table(found), end="")
    for line in wrong:
        stream = sys.stdout if options.check else sys.stderr
        print(f"Day {day.number}: {line}", file=stream)
    return cli.EXIT_FAILED if wrong else cli.EXIT_OK

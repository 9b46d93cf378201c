"""Turn each constant that a guide's numbers could hang on by two, and see what moves.

    make constants DAY=8                    the table that its guide shows
    python3 scripts/constants.py 8          the same
    python3 scripts/constants.py 8 --check  only what is not as it says

The list is `constants.py` in the day's folder: numbers, the constants of each, and why
it moves or stays. Where it does something else the reason is wrong, here or in the
guide, and this fails by name. `make docs` puts the table into the guide.

Exit code: 0 all as the list says, 1 something moves otherwise, 2 could not run.
"""

import sys

from labkit.base import cli
from labkit.lesson.constants import faults, numbers_of, table, unprinted
from labkit.lesson.day import chosen_day


def main() -> int:
    """Turn the constants of a day."""
    parser = cli.parser(__doc__)
    parser.add_argument("day", type=cli.day, nargs="?", help="default: worked on last")
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

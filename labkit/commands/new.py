"""Write the skeleton of a new day, which passes its own tests as it is.

    make new DAY=8 WEEK=w2-autonomy NAME=identification
    python3 scripts/new_day.py 8 w2-autonomy identification

A week that is not there yet gets its own files too. Nothing is overwritten. What to do
next: docs/teaching.md.
"""

from labkit.author.skeleton import new_day
from labkit.base import cli
from labkit.commands import docs
from labkit.lesson.day import find_day
from robo47.paths import shown


def main() -> int:
    """Write the files and fill their outputs in."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("day", type=cli.day, help="its number")
    add("week", help="its week's folder, or the number of one that is there")
    add("name", help="of its script: identification")
    options = parser.parse_args()
    for path in new_day(options.day, options.week, options.name):
        print(f"wrote {shown(path)}")
    docs.renew(docs.documents_of(find_day(options.day)))
    n = options.day
    print(f"Now: make notebook DAY={n}, make author DAY={n}, and docs/teaching.md")
    return cli.EXIT_OK

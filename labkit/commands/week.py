"""Run every lab of a week and print its numbers in one table.

    python3 scripts/run_week.py 1           week 1 (make week1)
    python3 scripts/run_week.py 1 --kit     the kit's labs alone

Each day runs with your own file where you began it, else with the kit's. The numbers
are the rows that the labs record, judged by the limits of the manifest; they are not
added to your log.
"""

from tqdm import tqdm

from labkit.base import cli
from labkit.base.text import count, number_of
from labkit.lesson.day import chosen_week, days_of
from labkit.lesson.writers import writers_of
from labkit.report.week_labs import LabResult, run_labs

Line = tuple[str, ...]  # day, whose, check, number, limit, verdict
HEAD = ("day", "whose", "check", "number", "limit", "")
NAMED = 30  # columns of a number's name


def lines_of(ran: LabResult) -> list[Line]:
    """Return a line per number of a day."""
    lines: list[Line] = []
    whose = "yours" if ran.mine else "kit's"
    if ran.mine and writers_of(ran.day).borrowed:
        whose = "part kit's"
    for one in ran.numbers:
        number = "none" if one.latest is None else number_of(one.latest)
        verdict = "PASS" if one.status == "pass" else "FAIL"
        name = ran.day.name_of(one.wanted)[:NAMED]
        limit = one.wanted.limit
        lines.append((str(ran.day.number), whose, name, number, limit, verdict))
    return lines


def as_table(lines: list[Line]) -> str:
    """Return the table, its columns as wide as they must be."""
    widths = [max(len(row[i]) for row in (HEAD, *lines)) for i in range(len(HEAD))]
    rows = []
    for line in (HEAD, *lines):
        cells = "  ".join(map(str.ljust, line[:-1], widths))
        mood = "good" if line[-1] == "PASS" else "bad"
        rows.append(f"{cells}  {cli.paint(line[-1], mood)}" if line[-1] else cells)
    return "\n".join(row.rstrip() for row in rows)


def main() -> int:
    """Run a week."""
    parser = cli.parser(__doc__)
    cli.add_week(parser)
    parser.add_argument("--kit", action="store_true", help="the kit's labs alone")
    parser.add_argument(
        "--no-log", action="store_true", help="as the labs have it; a week never logs"
    )
    options = parser.parse_args()
    days = days_of(chosen_week(options.week, options.day))
    running = run_labs(days, kits=options.kit)
    labs = list(tqdm(running, "labs", len(days), leave=False, disable=None))
    print(as_table([line for ran in labs for line in lines_of(ran)]))
    failed = [ran for ran in labs if not ran.passed]
    for ran in failed:
        number = ran.day.number
        again = f"make run DAY={number}" if ran.mine else f"make day{number}"
        why = ran.why or "a number is missing or beyond its limit"
        says = f"day {number} did not pass: {why}. See: {again}"
        print(cli.wrapped(says, "  "))
    counted = count(len(labs), "lab")
    if failed:
        return cli.conclude(False, f"{len(failed)} of {counted} did not pass")
    numbers = count(sum(len(day.metrics) for day in days), "number")
    return cli.conclude(True, f"{counted}, {numbers} within their limits")

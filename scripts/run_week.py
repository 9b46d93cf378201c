"""Run every lab of a week and print its numbers in one table.

    python3 scripts/run_week.py 1     week 1 (make week1)

Each day runs with your own file where you began it, else with the kit's. The numbers
are the rows that the labs record, judged by the limits of the manifest; they are not
added to your log.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)
from tqdm import tqdm

from robo47 import cli
from robo47.errors import Robo47Error
from robo47.lesson.day import Day, all_days
from robo47.lesson.lab import number_of
from robo47.metrics import read_rows

Line = tuple[int, str, str, str, str, str]  # day, whose, check, number, limit, verdict
HEAD = ("day", "whose", "check", "number", "limit")


def days_of(week: int) -> list[Day]:
    """Return the days of a week, in order.

    Raises:
        Robo47Error: the kit has no such week.
    """
    days = all_days()
    found = [day for day in days if day.folder.name.startswith(f"w{week}-")]
    if not found:
        weeks = sorted({day.folder.name for day in days})
        raise Robo47Error(f"there is no week {week} yet; the kit has {weeks}")
    return found


def run_lab(day: Day) -> tuple[int, dict[tuple[str, str], float]]:
    """Return a lab's exit code and the numbers it recorded, by check and metric."""
    script = day.work if day.work.is_file() else day.source
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "metrics.csv"
        done = subprocess.run(
            [sys.executable, str(script)],
            env={**os.environ, "ROBO47_METRICS": str(log)},
            capture_output=True,
            check=False,
        )
        rows = read_rows(log) if log.exists() else []
    values = {(str(r["check"]), str(r["metric"])): r["value"] for r in rows}
    return done.returncode, {k: float(v) for k, v in values.items() if v is not None}


def lines_of(day: Day) -> list[Line]:
    """Return a line per number of a day."""
    code, values = run_lab(day)
    whose = "yours" if day.work.is_file() else "kit's"
    lines: list[Line] = []
    for metric in day.metrics:
        value = values.get((metric.check, metric.metric))
        number = "none" if value is None else number_of(value)
        passes = code == 0 and value is not None and metric.passes(value)
        verdict = "PASS" if passes else "FAIL"
        lines.append((day.number, whose, metric.check, number, metric.limit, verdict))
    return lines


def as_table(lines: list[Line]) -> str:
    """Return the table, its columns as wide as they must be."""
    cells = [HEAD, *(tuple(map(str, line[:-1])) for line in lines)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(HEAD))]
    rows = ["  ".join(map(str.ljust, row, widths)) for row in cells]
    for i, line in enumerate(lines, 1):
        mood = "good" if line[-1] == "PASS" else "bad"
        rows[i] += "  " + cli.paint(line[-1], mood)
    return "\n".join(rows)


def main() -> int:
    """Run a week."""
    parser = cli.parser(__doc__)
    parser.add_argument("week", type=int, nargs="?", default=1, help="default: 1")
    days = days_of(parser.parse_args().week)
    quiet = not sys.stderr.isatty()
    lines = [
        line
        for day in tqdm(days, "labs", leave=False, delay=1, disable=quiet)
        for line in lines_of(day)
    ]
    print(as_table(lines))
    failed = [line for line in lines if line[-1] != "PASS"]
    for number in sorted({line[0] for line in failed}):
        print(f"day {number} did not pass; what it says: make run DAY={number}")
    return cli.EXIT_FAILED if failed else cli.EXIT_OK


if __name__ == "__main__":
    cli.run(main)

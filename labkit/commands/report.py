"""Turn the metrics log into a page worth showing.

    python3 scripts/report_metrics.py               metrics/report.html
    python3 scripts/report_metrics.py --day 1       one day of the course
    python3 scripts/report_metrics.py --check fk_by_hand --since 2026-09-01

The page works offline, on a phone and in the dark. Thresholds come from the
days' manifests. Rows that were repaired while reading or could not be read are
listed at the end of the page. Without a filter there is a page on the week of
the last day that you began as well, report-week1.html, and its numbers are
written between the marks of docs/RETRO_w1.md, where that file has them;
with --file they are left alone.
"""

import argparse
import datetime
from pathlib import Path

from labkit.base import cli
from labkit.base.words import command, count
from labkit.lesson.day import find_day, started_day
from labkit.log.progress import watched
from labkit.log.scan import scan
from labkit.report import page
from labkit.report.series import Report, collect, thresholds
from labkit.report.week_labs import week_of
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, shown


def main() -> int:
    """Write the report and say where it is."""
    args = parser().parse_args()
    lines = watched(scan(args.file), args.file)
    since = args.since.isoformat() if args.since else ""
    report = collect(lines, thresholds(), since, args.day, args.check)
    heading = describe(args, report)
    out = args.out or args.file.parent
    whole = not (since or args.check or args.day is not None)
    week = week_of(find_day(started_day())) if whole else None
    write(out / "report.html", page.render(report, heading, week).encode())
    if week is not None:
        write_week(report, heading, out, week, args.file)
    print(
        f"{count(report.rows, 'row')}; checks: {report.count('pass')} passing,"
        f" {report.count('fail')} failing, {report.count('none')} not run yet"
    )
    look = len(report.unread) + len(report.repaired)
    if look:
        need = f"{count(look, 'line')} {'needs' if look == 1 else 'need'} a look"
        print(f"{need}: {command('--check', args.file)}")
    return cli.EXIT_OK


def write_week(report: Report, heading: str, out: Path, week: int, log: Path) -> None:
    """Write the page on a week, and from the student's own log its retrospective."""
    from labkit.report import week_page, week_retro
    from labkit.report.week_facts import facts_of
    from labkit.report.week_labs import days_of

    series = {(one.day, one.check, one.metric): one for one in report.series}
    facts = [facts_of(day, series) for day in days_of(week)]
    write(out / f"report-week{week}.html", week_page.render(facts, heading).encode())
    if log.resolve() == METRICS_CSV.resolve():  # another log's numbers are not mine
        for path in week_retro.fill(facts):
            print(f"its numbers are in {shown(path)}")


def parser() -> argparse.ArgumentParser:
    """Return the command line's description."""
    it = cli.parser(__doc__)
    it.add_argument(
        "--since",
        type=datetime.date.fromisoformat,
        metavar="YYYY-MM-DD",
        help="rows of that date and later",
    )
    it.add_argument("--day", type=int, help="one day of the course")
    it.add_argument("--check", default="", metavar="NAME", help="one check")
    cli.add_log(it)
    it.add_argument(
        "--out", type=Path, metavar="FOLDER", help="default: the log's own folder"
    )
    return it


def describe(args: argparse.Namespace, report: Report) -> str:
    """Return one line on which rows these are."""
    parts = [f"{count(report.rows, 'row')} of {shown(args.file.absolute())}"]
    parts += [f"since {args.since}"] if args.since else []
    parts += [f"day {args.day}"] if args.day is not None else []
    parts += [f"check {args.check}"] if args.check else []
    return ", ".join(parts) + f"; made on {datetime.date.today()}"


def write(path: Path, content: bytes) -> None:
    """Write a file and name it."""
    try:
        path.write_bytes(content)
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path)}: {error.strerror or error}. Choose another"
            " folder with --out."
        ) from None
    print(f"wrote {shown(path.absolute())}")

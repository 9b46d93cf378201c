"""Write a page about the numbers in the metrics log.

    python3 scripts/report_metrics.py               metrics/report.html
    python3 scripts/report_metrics.py --week 1      the page of one week alone
    python3 scripts/report_metrics.py --day 1       one day of the course
    python3 scripts/report_metrics.py --check fk_by_hand --since 2026-09-01

The page works offline, on a phone and in dark mode. The thresholds come from the
manifests of the days, and the predictions from your worksheets. The end of the page
lists lines that could not be read or may be truncated. Without a filter, the command
also writes a page for each week that you have begun, report-week1.html, and writes its
numbers between the marks in docs/RETRO_w1.md, if that file has marks. With --file, it
leaves them unchanged.
"""

import argparse
import datetime
from collections.abc import Sequence
from pathlib import Path

from labkit.base import cli
from labkit.base.text import count
from labkit.check import memory
from labkit.hunt.tally import tally
from labkit.lesson.day import Day, all_days, chosen_week, days_of, find_day
from labkit.lesson.week import Week, weeks
from labkit.lesson.writers import Writers, writers_of
from labkit.log.logfile import command
from labkit.log.scan import watched
from labkit.report import page
from labkit.report.series import Report, Series, collect, series_of
from labkit.report.week_facts import facts_of
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, shown


def main() -> int:
    """Write the report and say where it is."""
    args = parser().parse_args()
    lines = watched(args.file)
    since = str(args.since or "")
    asked_week = None if args.week is None else chosen_week(args.week, args.day)
    filtered = bool(since or args.check or args.day is not None)
    if asked_week and filtered:
        raise Robo47Error("a week's page has all its rows: leave the other filter out")
    days = all_days() if args.day is None else [find_day(args.day)]
    mine = args.file.resolve() == METRICS_CSV.resolve()
    asked = list[Series]()
    for day in days:
        writers = writers_of(day)  # nobody knows the files of another log
        asked += series_of(day, [], writers if mine else Writers(writers.kits))
    report = collect(lines, asked, since, args.day, args.check)
    heading = describe(args, report)
    out = args.out or args.file.parent
    shown_weeks = [] if filtered else begun(report)
    if asked_week:  # the pages of the other weeks may be there from an earlier run
        shown_weeks = [w for w in shown_weeks if (out / page_of(w)).is_file()]
    else:
        checked = {day.number: last_check(day) for day in days} if mine else {}
        beside = [week.number for week in shown_weeks]
        sheets = {day.number: worksheet_of(day) for day in days} if mine else {}
        own_days = [facts_of(day, report.series) for day in days] if mine else []
        text = page.render(
            report, heading, beside, checked, sheets, own_days, memory.journal()
        )
        write(out / "report.html", text)
    for week in [asked_week] if asked_week else shown_weeks:
        write_week(report, heading, out, week, shown_weeks, mine)
    print(
        f"{count(report.rows, 'row')}; checks: {report.count('pass')} passing,"
        f" {report.count('fail')} failing,"
        f" {report.count('none') + report.count('kit')} not run yet"
    )
    if hunts := tally(report.hunts):
        print(f"bug hunts: {hunts}")
    if mine:
        tell(report, days_of(asked_week) if asked_week else days)
    if look := len(report.look):
        need = f"{count(look, 'line')} {'needs' if look == 1 else 'need'} a look"
        print(f"{need}: {command('--check', args.file)}")
    return cli.EXIT_OK


def begun(report: Report) -> list[Week]:
    """Return the weeks that have a lab of the student's or a row; else the one to do.

    Args:
        report: of a whole log.
    """
    rows = {one.day for one in report.series if one.latest is not None}
    found = [
        week
        for week in weeks()
        if any(day.work.is_file() or day.number in rows for day in days_of(week))
    ]
    return found or [chosen_week(None)]


def page_of(week: Week) -> str:
    """Return the name of the page on a week."""
    return f"report-week{week.number}.html"


def write_week(
    report: Report,
    heading: str,
    out: Path,
    week: Week,
    beside: Sequence[Week],
    mine: bool,
) -> None:
    """Write the page on a week, and from the student's own log its retrospective."""
    from labkit.report import week_page, week_retro

    facts = [facts_of(day, report.series) for day in days_of(week)]
    others = [other.number for other in beside if other != week]
    whole = (out / "report.html").is_file()
    text = week_page.render(facts, heading, others, whole=whole)
    write(out / page_of(week), text)
    if mine:  # another log's numbers are not mine
        for path in week_retro.fill(facts):
            print(f"its numbers are in {shown(path)}: commit it")


def worksheet_of(day: Day) -> str:
    """Return the text of a day's worksheet; "" where none can be read."""
    try:
        data = (day.folder / day.worksheet).read_bytes() if day.worksheet else b""
    except OSError:
        return ""
    return data.decode("utf-8-sig", "replace")


def last_check(day: Day) -> str:
    """Return a line on what the last check found in the student's file as it is."""
    if not day.work.is_file():
        return f"Not begun: make start DAY={day.number}"
    known = memory.task_states(day)
    if any(task.id not in known for task in day.tasks):
        return f"Not checked in this version: make check DAY={day.number}."
    left = [f"{t.id} {known[t.id]}" for t in day.tasks if known[t.id] != "passed"]
    of = len(day.tasks)
    passed = f"The last check: {of - len(left)} of {of} tasks pass"
    return f"{passed}; {', '.join(left)}." if left else f"{passed}."


def tell(report: Report, days: list[Day]) -> None:
    """Say which of the begun days need a run or a check of the file as it is."""
    begun = [day for day in days if day.work.is_file()]
    known = {day.number: memory.task_states(day) for day in begun}
    unchecked = [str(day.number) for day in begun if not known[day.number]]
    if len(unchecked) > 1:  # one sentence for all of them
        *some, last = unchecked
        which = f"days {', '.join(some)} and {last}: Not checked in this version:"
        print(cli.wrapped(f"{which} make check DAY={some[0]}, and so on.", "  "))
    for day in begun:
        found = known[day.number]
        done = all(found.get(t.id) == "passed" for t in day.tasks if not t.optional)
        told = done or (len(unchecked) > 1 and not found)
        says = [] if told else [last_check(day)]
        own = [one for one in report.series if one.day == day.number]
        if stale := sum(one.status == "stale" for one in own):
            old = f"{count(stale, 'number')} from before your file changed"
            says.append(f"{old}: make run DAY={day.number}.")
        if says:
            print(cli.wrapped(f"day {day.number}: {' '.join(says)}", "  "))


def parser() -> argparse.ArgumentParser:
    """Return the command line's description."""
    it = cli.parser(__doc__)
    it.add_argument(
        "--since",
        type=datetime.date.fromisoformat,
        metavar="YYYY-MM-DD",
        help="rows of that date and later",
    )
    it.add_argument("--week", type=cli.week, help="the page of this week alone")
    it.add_argument("--day", type=cli.day, help="one day of the course")
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


def write(path: Path, text: str) -> None:
    """Write a file and name it."""
    try:
        path.write_bytes(text.encode())
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path)}: {error.strerror or error}. Choose another"
            " folder with --out."
        ) from None
    print(f"wrote {shown(path.absolute())}")

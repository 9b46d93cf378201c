"""The report as one HTML file that needs nothing else: no script, no font, no net."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from itertools import groupby

from labkit.base import html
from labkit.base.text import count
from labkit.check.memory import Entry
from labkit.hunt.tally import tally
from labkit.lesson.day import all_days
from labkit.log.rows import Row
from labkit.log.scan import Line
from labkit.report import overview, plot, prediction_plot
from labkit.report.series import Report, Series, failures_of, value_of
from labkit.report.week_facts import OwnDay

RECENT = 20  # runs listed under a plot
LISTED = 200  # lines listed that need a look
STATUS = {
    "pass": ("✓", "pass"),
    "fail": ("✗", "fail"),
    "open": ("•", "no threshold"),
    "none": ("○", "not run yet"),
    "kit": ("○", "the kit's run alone"),
    "stale": ("↻", "your file changed since"),
    "unsigned": ("•", "no file named"),
    "borrowed": ("•", "partly borrowed"),
}
COLUMNS = ("date", "value", "commit", "failures", "config", "method", "notes")
AGAIN = ("stale", "unsigned", "borrowed")  # worth nothing until a run of one's own
NOTHING = (
    '<h2>Nothing recorded yet</h2><p class="muted">Run a lab of yours: '
    "<code>make run DAY=1</code></p>"
)


def links(weeks: Sequence[int]) -> str:
    """Return links to the pages of weeks, each after a dot; "" for none."""
    names = (f'<a href="report-week{week}.html">Week {week}</a>' for week in weeks)
    return "".join(f" · {name}" for name in names)


def render(
    report: Report,
    heading: str,
    weeks: Sequence[int] = (),
    checked: Mapping[int, str] | None = None,
    sheets: Mapping[int, str] | None = None,
    own_days: Sequence[OwnDay] = (),
    journal: Sequence[Entry] = (),
) -> str:
    """Return the whole page.

    Args:
        report: what to show.
        heading: one line of plain text on where the rows come from.
        weeks: those whose own pages stand beside this one.
        checked: what the last check found, a line of plain text by day.
        sheets: the worksheets' text by day, for the predictions.
        own_days: how the student's own days stand; none of another log.
        journal: the changes of their tasks' verdicts, oldest first.
    """
    beside = links(weeks)
    checked, sheets = checked or {}, sheets or {}
    return html.page(
        "robo47 metrics",
        escape(heading) + beside,
        _tiles(report),
        *([] if report.rows else [NOTHING]),
        overview.days_table(own_days, journal),
        _margins(report.series),
        overview.mistakes(own_days) if any(one.met for one in own_days) else "",
        _jumps(report),
        *_days(report, checked, sheets),
        _hunts(report.hunts),
        _look(report.look),
        style=overview.STYLE,
    )


def _days(
    report: Report, checked: Mapping[int, str], sheets: Mapping[int, str]
) -> Iterator[str]:
    """Yield a section for each day, those without a number in one that is folded."""
    later = []
    for day, some in groupby(report.series, key=lambda series: series.day):
        numbers = list(some)
        said = checked.get(day or 0, "")
        section = _day(day, numbers, said, sheets.get(day or 0, ""))
        if said.startswith("The last") or any(n.rows or n.kits for n in numbers):
            yield section
        else:
            later.append(section)
    if later:
        title = f"{count(len(later), 'day')} without a number yet"
        yield html.folded(title, *later, opened=not report.rows)


def _margins(series: Sequence[Series]) -> str:
    drawn = overview.margins(
        overview.Bar(one, one.latest, one.status) for one in series
    )
    about = (
        '<p class="muted">Each bar is a number of your last run. It starts at the'
        " limit, and its length is the factor between the two, on a logarithmic scale."
        " A bar to the left is beyond its limit.</p>"
    )
    return drawn and html.section("Margins", about, drawn)


def _tiles(report: Report) -> str:
    """Return the counters; those of 0 are no news, but for what passes."""
    tiles = [
        ("pass" if report.count("pass") else "none", report.count("pass"), "passing"),
        ("fail" if report.count("fail") else "none", report.count("fail"), "failing"),
        ("none", report.count("open"), "without a threshold"),
        ("none", sum(map(report.count, AGAIN)), "to run again"),
        ("none", report.count("none") + report.count("kit"), "not run yet"),
        ("", report.rows, "rows"),
        ("fail" if report.look else "none", len(report.look), "lines to look at"),
    ]
    told = [tile for tile in tiles if tile[1] or tile[2] == "passing"]
    return html.tiles((role, f"{count:,}", label) for role, count, label in told)


def _title(day: int | None) -> str:
    return "No day" if day is None else f"Day {day}"


def _heading(day: int | None) -> str:
    """Return "Day 5: Control of the joints", without a title for an unknown day."""
    titles = {one.number: f": {escape(one.title)}" for one in all_days()}
    return _title(day) + titles.get(day or 0, "")


def _jumps(report: Report) -> str:
    """Return a link to each day, where there are several."""
    days = dict.fromkeys(series.day for series in report.series)
    failing = {series.day for series in report.series if series.status == "fail"}
    if len(days) < 2:
        return ""
    links = ", ".join(
        f'<a class="{"fail" if day in failing else "open"}" href="#{day}">'
        f"{_title(day)}</a>"
        for day in days
    )
    return f'<p class="jumps">{links}</p>'


def _day(day: int | None, series: Iterable[Series], checked: str, sheet: str) -> str:
    foreseen = prediction_plot.draw(sheet)
    foreseen = foreseen and html.card("Predicted and measured", foreseen)
    numbers = list(series)
    about = checked and f'<p class="muted">{escape(checked)}</p>'
    title = f"Every run of {count(len(numbers), 'number')}"
    plots = f'<div class="cards">{"".join(map(_card, numbers))}</div>'
    return html.section(
        _heading(day),
        about,
        foreseen and f'<div class="cards">{foreseen}</div>',
        html.folded(title, plots, opened=any(n.status == "fail" for n in numbers)),
        id=str(day),
    )


def _hunts(rows: Sequence[Row]) -> str:
    """Return what came of the bug hunts; "" where nobody hunted."""
    if not rows:
        return ""
    names = {
        "date": "date",
        "day": "day",
        "level": "method",
        "seed": "seed",
        "runs": "value",
        "checks": "n_trials",
        "wrong": "n_failures",
        "how it ended": "notes",
    }
    head = "".join(f"<th>{name}</th>" for name in names)
    body = []
    for row in rows[-LISTED:]:
        cells = (escape(_hunted(row[name])) for name in names.values())
        body.append(f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
    table = html.folded("Hunt by hunt", html.table(head, body, "scroll"))
    return html.section("Bug hunts", f"<p>{escape(tally(rows))}</p>", table)


def _hunted(cell: object) -> str:
    text = f"{cell:g}" if isinstance(cell, float) else str(cell)
    return _clipped(text.removeprefix("level "))


def _card(series: Series) -> str:
    mark, words = STATUS[series.status]
    best = "best" if series.bounds else "lowest"
    limits = ", ".join(f"{sign} {bound:g}" for sign, bound in series.bounds)
    unit = f" {escape(series.wanted.unit)}" if series.rows else ""
    facts = [
        ("latest", plot.number(series.latest) + unit),
        (best, plot.number(series.best)),
        ("runs", f"{len(series.rows):,}"),
        ("threshold", escape(limits or "–")),
    ]
    if series.kits:
        facts.append(("the kit's", plot.number(series.kit)))
    judged = series.status in ("pass", "fail")
    role = {"latest": f' class="{series.status}"'} if judged else {}
    terms = "".join(
        f"<div><dt>{name}</dt><dd{role.get(name, '')}>{value}</dd></div>"
        for name, value in facts
    )
    failed = failures_of(series.rows[-1]) if series.rows else ""
    failed = failed and f'<p class="fail">{failed}</p>'
    return (
        f'<article class="card"><div class="top"><div>{_named(series)}</div>'
        f'<span class="badge {series.status}">{mark} {words}</span></div>'
        f"<dl>{terms}</dl>{failed}{plot.draw(series)}"
        f"{_recent(series.rows)}{_recent(series.kits, ' of the kit')}</article>"
    )


def _named(series: Series) -> str:
    """Return what a number is called: a sentence where it has one, and its names."""
    check, metric = map(_text, (series.wanted.check, series.wanted.metric))
    if says := series.wanted.says:
        name = f'<span class="muted">{check}, {metric}</span>'
        return f"<h3>{escape(says)}</h3>{name}"
    return f'<h3>{check}</h3><span class="muted">{metric}</span>'


def _text(cell: object) -> str:
    return escape(str(cell)) or '<span class="muted">(empty)</span>'


def _recent(rows: list[Row], whose: str = "") -> str:
    if not rows:
        return ""
    shown = reversed(rows[-RECENT:])
    title = count(len(rows), "run") + whose
    if len(rows) > RECENT:
        title = f"The latest {RECENT} of {title}"
    head = "".join(f"<th>{name}</th>" for name in COLUMNS)
    return html.folded(title, html.table(head, map(_run, shown), "scroll"))


def _run(row: Row) -> str:
    of = "?" if row["n_trials"] is None else row["n_trials"]
    failures = "" if row["n_failures"] is None else f"{row['n_failures']} of {of}"
    value = plot.number(value_of(row))
    cells = (row["date"], value, row["git_sha"], failures, row["config"], row["method"])
    inner = "".join(f"<td>{escape(_clipped(str(cell)))}</td>" for cell in cells)
    notes = escape(_clipped(str(row["notes"])))
    return f'<tr>{inner}<td class="note">{notes}</td></tr>'


def _look(lines: list[Line]) -> str:
    if not lines:
        return ""
    rows = (
        f"<tr><td>{line.number}</td><td class=note>{escape(line.problem)}</td>"
        f"<td class=note><code>{escape(_clipped(line.text))}</code></td></tr>"
        for line in lines[:LISTED]
    )
    more = len(lines) - LISTED
    rest = f'<p class="muted">and {more:,} more</p>' if more > 0 else ""
    rest += (
        '<p class="muted">More: <code>python3 scripts/log_metric.py --check</code></p>'
    )
    head = "<th>line</th><th>why</th><th>text</th>"
    return html.section(
        f"Lines to look at ({len(lines):,})", html.table(head, rows, below=rest)
    )


def _clipped(text: str, most: int = 300) -> str:
    return text if len(text) <= most else f"{text[:200]} … {text[-90:]}"

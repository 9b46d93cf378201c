"""A week as one HTML page that needs nothing else: no script, no font, no net."""

from collections.abc import Sequence
from html import escape

from labkit.base import html
from labkit.base.text import number_of
from labkit.report import overview
from labkit.report.page import STATUS, links
from labkit.report.series import Series, cell_of, limit_of, with_unit
from labkit.report.week_facts import OwnDay

STYLE = """
body { max-width: 980px; }
td.n, th.n { text-align: right; } td.day { font-weight: 600; }
tr.first td { border-top: 2px solid var(--grid); } tr.first:nth-child(2) td {
  border-top: 1px solid var(--grid); }
td.pass, td.fail, td.none { white-space: normal; min-width: 84px; }
table { font-size: 14px; margin-top: 0; } th, td { padding: 6px 14px 6px 0; }
th:last-child, td:last-child { padding-right: 0; } td.wide { white-space: normal;
  min-width: 160px; }
.bar { display: inline-block; width: 90px; height: 9px; margin-right: 9px;
  border-radius: 5px; background: var(--grid); overflow: hidden; }
.bar i { display: block; height: 100%; background: var(--pass); }
.last { margin-top: 32px; }
@media (max-width: 500px) { th, td { padding-right: 7px; } .card { padding: 10px; }
  .bar { display: none; } td.wide { min-width: 120px; } }
"""

_MARKS = {status: f"{mark} {words}" for status, (mark, words) in STATUS.items()}
_MARKS |= {"none": "○ no row yet", "kit": "○ the kit's file ran"}


def render(
    facts: Sequence[OwnDay],
    heading: str,
    others: Sequence[int] = (),
    *,
    whole: bool = True,
) -> str:
    """Return the whole page.

    Args:
        facts: of the week's days, in order.
        heading: one line of plain text on where this comes from.
        others: numbers of the weeks whose pages stand beside this one.
        whole: whether the page on all runs stands there, too.
    """
    plots = '<a href="report.html">report.html</a>' if whole else "make report"
    return html.page(
        escape(facts[0].day.week.heading),
        escape(heading) + links(others),
        _tiles(facts),
        _numbers(facts),
        _days(facts),
        overview.mistakes(facts),
        f'<p class="muted last">Every run as a plot: {plots}. '
        "Hints and mistakes are on your machine alone.</p>",
        style=STYLE,
    )


def minutes_in_words(minutes: int | None) -> str:
    """Return a time as people say it: "50 min", "3 h 20 min", "2 days"."""
    if minutes is None:
        return "–"
    if minutes < 60:
        return f"{minutes} min"
    if minutes < 1440:
        return f"{minutes // 60} h {minutes % 60:02} min"
    return f"{minutes / 1440:.1f} days"


def _tiles(facts: Sequence[OwnDay]) -> str:
    numbers = [number for one in facts for number in one.numbers]
    right = sum(number.status == "pass" for number in numbers)
    met = [m for one in facts for m in one.met]
    graded = [passed for one in facts for passed in one.graded]
    own = sum(len(one.own) for one in facts)
    tiles = [
        (sum(graded), len(graded), "tasks pass"),
        (right, len(numbers), "numbers within limits"),
        (own, sum(f.functions for f in facts), "functions yours"),
        (sum(m.now == "left behind" for m in met), len(met), "mistakes left behind"),
    ]
    cells = [
        ("pass" if n and n == of else "", f"{n:,} of {of:,}", label)
        for n, of, label in tiles
    ]
    return html.tiles([*cells, ("", f"{sum(f.hints for f in facts):,}", "hints asked")])


def _numbers(facts: Sequence[OwnDay]) -> str:
    kits = any(number.kit is not None for one in facts for number in one.numbers)
    rows = [
        _number(one, number, first=i == 0, kits=kits)
        for one in facts
        for i, number in enumerate(one.numbers)
    ]
    # A phone shows the first four columns, so the important ones come first.
    head = (
        "<th>day</th><th>number</th><th class=n>yours</th><th></th><th>limit</th>"
        "<th class=n>your worst on the way</th>"
        + ("<th class=n>the kit's here</th>" if kits else "")
    )
    return html.section("The numbers", html.table(head, rows))


def _number(one: OwnDay, number: Series, *, first: bool, kits: bool) -> str:
    role = number.status if number.status in ("pass", "fail") else "none"
    mark = _MARKS[number.status]
    day = one.day.number if first else ""
    kit = f"<td class=n>{_value(number.kit)}</td>" if kits else ""
    return (
        f"<tr{' class=first' if first else ''}><td class=day>{day}</td>"
        f"<td class=wide>{cell_of(one.day, number.wanted)}</td>"
        f"<td class=n>{with_unit(number.latest, number.wanted)}</td>"
        f'<td class="{role}">{mark}</td>'
        f"<td>{limit_of(number.wanted)}</td>"
        f"<td class=n>{_value(number.worst)}</td>{kit}</tr>"
    )


def _days(facts: Sequence[OwnDay]) -> str:
    rows = [
        f"<tr><td class=day>{one.day.number}</td>"
        f"<td class=wide>{escape(one.day.title)}</td>"
        f"{_counts(one)}"
        f"<td>{minutes_in_words(one.minutes)}"
        f" of {minutes_in_words(one.day.minutes)}</td>"
        f"<td>{one.hints or '–'}</td></tr>"
        for one in facts
    ]
    head = (
        "<th>day</th><th></th><th>tasks that pass</th><th>functions yours</th>"
        "<th>first to last commit, of the time planned</th><th>hints</th>"
    )
    return html.section("The days", html.table(head, rows))


def _counts(one: OwnDay) -> str:
    if not one.checked:
        command = f"<code>make check DAY={one.day.number}</code>"
        return (
            f"<td colspan=2 class=wide>not checked in this version: run {command}</td>"
        )
    passed = sum(one.graded)
    of = len(one.graded)
    borrowed = ""
    if one.borrowed:
        borrowed = f"<br>borrowed: {', '.join(one.borrowed)}"
    share = f"{100 * passed / max(1, of):.0f}%"
    return (
        f'<td><span class=bar><i style="width:{share}"></i></span>{passed} of {of}</td>'
        f"<td>{len(one.own)} of {one.functions}{borrowed}</td>"
    )


def _value(value: float | None) -> str:
    return "–" if value is None else number_of(value)

"""The course at a glance: a row for each day, and each number against its limit.

All text from a student or a log is escaped. A role is a colour of the page's style, by
name.
"""

import math
from collections.abc import Iterable, Sequence
from html import escape
from itertools import groupby
from typing import NamedTuple

from labkit.base import html
from labkit.check.memory import Entry, MetMistake
from labkit.lesson.day import Day
from labkit.report.generic_verdicts import in_words
from labkit.report.series import Series, limit_of, with_unit
from labkit.report.week_facts import OwnDay

MARGINS = """
.margins { max-width: 760px; margin-bottom: 14px; }
@media (max-width: 500px) { .margins svg { font-size: 20px; } }
"""
STYLE = (
    MARGINS
    + """
.squares i, .attempts i { display: inline-block; width: 13px; height: 13px;
  margin: 2px 2px 0 0; border-radius: 3px; background: var(--grid); }
.attempts i { width: 8px; height: 8px; border-radius: 50%; }
.squares i.pass, .attempts i.pass { background: var(--pass); }
.squares i.fail, .attempts i.fail { background: var(--fail); }
td.squares, td.attempts { white-space: normal; line-height: 1; min-width: 90px; }
td.day { white-space: normal; min-width: 110px; }
td.wide { white-space: normal; min-width: 160px; }
@media (max-width: 500px) {  /* a day has two lines, and says what its hints are */
  table:has(.squares) tr:first-child { display: none; }
  tr:has(> .squares) { display: grid; grid-template-columns: auto 1fr auto; }
  tr:has(> .squares) > td { border-top: 0; padding: 0 12px 6px 0; min-width: 0; }
  tr:has(> .squares) > .day { grid-column: 1 / -1; padding-top: 6px;
    border-top: 1px solid var(--grid); }
  td.hints:not(:empty)::before { content: "hints: "; color: var(--muted); } }
"""
)
ATTEMPTS = 60  # the most dots of a day
WIDTH, LEFT, RIGHT = 720, 84, 712
PITCH = 11  # pixels, from one bar to the next
GAP = 9  # pixels, between two days
DECADES = 4.0  # to the right of the limit, at least
MOST = 16.0  # the most decades that are drawn, as many as for a number of 0
# The colour and the mark of how a mistake stands now.
_MOODS = {"left behind": ("pass", "✓"), "still there": ("fail", "✗")}
ROLES = {"passed": "pass", "wrong": "fail", "close": "fail"}


class Bar(NamedTuple):
    """A number of the picture of margins."""

    series: Series  # has its name and its limits
    value: float | None
    status: str  # "pass", "fail", or another word for a number that is not counted


def days_table(days: Sequence[OwnDay], journal: Sequence[Entry]) -> str:
    """Return a row for each day that was begun: its tasks, its attempts, its hints.

    Args:
        days: how each day stands.
        journal: the changes of the tasks' verdicts, oldest first.
    """
    rows = [_day(one, journal) for one in days if one.day.work.is_file()]
    head = "<th>day</th><th>tasks</th><th>attempts, oldest first</th><th>hints</th>"
    about = (
        '<p class="muted">A square is a task. It is green if the task passes with the'
        " present version of your file. A dot is a new verdict of"
        " <code>make check</code> on a task.</p>"
    )
    return html.section("The days", about, html.table(head, rows)) if rows else ""


def _day(one: OwnDay, journal: Sequence[Entry]) -> str:
    squares = [
        (one.states.get(task.id, ""), f"{task.id} {', '.join(task.functions)}: ")
        for task in one.day.tasks
    ]
    tasks = "".join(
        _mark(state, words + (state or "not checked in this version"))
        for state, words in squares
    )
    ids = {task.id for task in one.day.tasks}
    tried = [entry for entry in journal if entry.task in ids][-ATTEMPTS:]
    dots = "".join(_mark(entry.status, _attempt(entry)) for entry in tried)
    number = one.day.number
    return (
        f'<tr><td class=day><a href="#{number}">{number}</a>'
        f" <span class=muted>{escape(one.day.title)}</span></td>"
        f"<td class=squares>{tasks}</td><td class=attempts>{dots or '–'}</td>"
        f"<td class=hints>{one.hints or '–'}</td></tr>"
    )


def _mark(state: str, words: str) -> str:
    return f'<i class="{ROLES.get(state, "")}" title="{escape(words)}"></i>'


def _attempt(entry: Entry) -> str:
    says = f": {entry.says}" if entry.says else ""
    return f"{entry.task} {entry.status}{says}"


def mistakes(facts: Sequence[OwnDay]) -> str:
    """Return the named mistakes that were met, and whether they are still there."""
    rows = [_mistake(one.day, met) for one in facts for met in one.met]
    nothing = '<p class="muted">None so far: <code>make check</code> names them.</p>'
    head = "<th>task</th><th>what was wrong</th><th>now</th>"
    return html.section(
        "The mistakes you met", html.table(head, rows) if rows else nothing
    )


def _mistake(day: Day, met: MetMistake) -> str:
    role, mark = _MOODS.get(met.now, ("none", "•"))
    name = escape(in_words(met.mistake))
    says = met.says and f"<br><span class=muted>{escape(met.says)}</span>"
    names = ", ".join(f for t in day.tasks if t.id == met.task for f in t.functions)
    return (
        f"<tr><td class=day>{escape(met.task)}</td>"
        f"<td class=wide>{escape(names)}: {name}{says}</td>"
        f"<td class={role}>{mark} {met.now}</td></tr>"
    )


def margin(series: Series, value: float | None) -> float | None:
    """Return by how many powers of ten a number is inside its limit.

    Args:
        series: has the limits.
        value: the number; None where there is none.

    Returns:
        Negative beyond the limit; None without a finite number or without a positive
        limit, because their ratio says nothing then.
    """
    found = []
    if value is None or not math.isfinite(value):
        return None
    for sign, bound in series.bounds:
        if bound <= 0 or value < 0:
            return None
        limit, number = math.log10(bound), math.log10(value) if value else -math.inf
        found.append(limit - number if sign == "<" else number - limit)
    return max(-MOST, min(MOST, *found, MOST)) if found else None


def margins(numbers: Iterable[Bar]) -> str:
    """Return bars of all numbers with a limit, on a logarithmic scale; "" for none."""
    known = [
        (bar, far)
        for bar in numbers
        if (far := margin(bar.series, bar.value)) is not None
    ]
    if not known:
        return ""
    scale = _Scale([far for _, far in known])
    parts, y = [], 16.0
    for day, some in groupby(known, key=lambda pair: pair[0].series.day):
        parts.append(_text(LEFT - 8, y + 8, f"Day {day}", ' text-anchor="end"'))
        for bar, far in some:
            parts.append(_bar(bar, scale.x(0), scale.x(far), y))
            y += PITCH
        y += GAP
    parts = [*scale.lines(y), *parts]
    inside = sum(far > 0 for _, far in known)
    says = f"{inside} of {len(known)} numbers are inside their limits."
    svg = (
        f'<svg viewBox="0 0 {WIDTH} {y + 16:.0f}" role="img" aria-label="{says}">'
        f"{''.join(parts)}</svg>"
    )
    return f'<div class="card margins">{svg}</div>'


class _Scale:
    """Where a margin is, between the largest one beyond a limit and the largest one."""

    def __init__(self, margins: Sequence[float]) -> None:
        self.low = float(math.floor(min(0.0, *margins)))
        self.high = float(math.ceil(max(DECADES, *margins)))

    def x(self, margin: float) -> float:
        """Return the place of a margin."""
        return LEFT + (margin - self.low) / (self.high - self.low) * (RIGHT - LEFT)

    def lines(self, bottom: float) -> list[str]:
        """Return the limit, and a line for each of a few powers of ten."""
        step = math.ceil((self.high - self.low) / 6)
        found = []
        for power in range(int(self.low), int(self.high) + 1):
            if power % step == 0:
                role = "grid" if power else "limit"
                x = self.x(power)
                found.append(
                    f'<path d="M{x:.1f} 12V{bottom:.0f}" stroke="var(--{role})"/>'
                )
                anchor = "end" if x > RIGHT - 20 else "middle"
                more = f' text-anchor="{anchor}"'
                found.append(_text(x, bottom + 12, _factor(power), more))
        return found


def _factor(power: int) -> str:
    exponent = str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return "limit" if power == 0 else f"× 10{exponent}"


def _bar(bar: Bar, start: float, end: float, y: float) -> str:
    wanted = bar.series.wanted
    name = wanted.says or f"{wanted.check}, {wanted.metric}"
    words = f"{escape(name)}: {with_unit(bar.value, wanted)}, {limit_of(wanted)}"
    left, width = min(start, end), max(abs(end - start), 2.0)
    role = bar.status if bar.status in ("pass", "fail") else "muted"
    return (
        f'<rect x="{left:.1f}" y="{y + 1:.1f}" width="{width:.1f}" height="7" rx="2"'
        f' fill="var(--{role})"><title>{words}</title></rect>'
    )


def _text(x: float, y: float, words: str, more: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="var(--muted)"{more}>{words}</text>'

"""A class over several days as one HTML page, with links to the pages of the days."""

from html import escape

from labkit.base import html
from labkit.base.text import count
from labkit.grade.charts import STYLE as PAGE_STYLE
from labkit.grade.charts import Row, chart, legend
from labkit.grade.overview import state
from labkit.grade.roster import Student
from labkit.grade.sheet import Graded, percent_of, printable
from labkit.grade.week import STATES, Week
from labkit.lesson.day import Day

ROLES = dict(
    zip(STATES, ("pass", "line", "fail", "broken", "none", "dark"), strict=True)
)
STYLE = PAGE_STYLE + "td.n, th.n { text-align: right; }\n"


def render(week: Week) -> str:
    """Return the whole page."""
    title = f"Days {week.days[0].number} to {week.days[-1].number}"
    about, days, everybody = _about(week), _days(week), _table(week)
    return printable(html.page(title, about, days, everybody, style=STYLE))


def _about(week: Week) -> str:
    done = [s for s in week.students if all(state(one) == "done" for one in week.of(s))]
    return f"{count(len(week.students), 'student')}; {len(done):,} passed every task"


def _days(week: Week) -> str:
    rows = [_bar(week, day) for day in week.days]
    marks = legend((role, escape(where)) for where, role in ROLES.items())
    bars = chart(rows, "students by how they stand, day by day")
    mistakes = "".join(_mistakes(week, day) for day in week.days)
    return html.section(
        "The days",
        '<div class="two">',
        html.card("How far the class is", marks, bars),
        html.card("Which mistakes were common", f"<ul>{mistakes}</ul>"),
        "</div>",
    )


def _bar(week: Week, day: Day) -> Row:
    counts = week.counts(day)
    parts = [(role, counts[where]) for where, role in ROLES.items()]
    words = f"{counts['done']:,} of {len(week.students):,} done"
    return Row(f"{day.number}  {day.title}", words, parts, len(week.students))


def _mistakes(week: Week, day: Day) -> str:
    words = ", ".join(
        f"{escape(task)} <b>{escape(name)}</b> ({number})"
        for task, name, number in week.mistakes[day.number]
    )
    return (
        f'<li><div class="head"><a href="day{day.number}/class.html">'
        f"Day {day.number}</a></div><p>{words or 'none'}</p></li>"
    )


def _table(week: Week) -> str:
    head = "".join(
        f'<th class=n><a href="day{day.number}/class.html">{day.number}</a></th>'
        for day in week.days
    )
    return html.section(
        "Everybody <small>tasks that pass, by day</small>",
        html.table(
            f"<th>name</th><th class=n>per cent</th>{head}",
            (_row(week, student) for student in week.students),
            "card scroll all",
        ),
    )


def _row(week: Week, student: Student) -> str:
    cells = "".join(map(_cell, week.of(student)))
    share = percent_of(week.percent(student)) or "?"
    return f"<tr><td>{escape(student.name)}</td><td class=n>{share}</td>{cells}</tr>"


def _cell(one: Graded) -> str:
    words, where = "?", state(one)
    if one.percent is not None:
        words = f"{one.tasks_passed} of {len(one.result.tasks)}"
    role = ROLES[where] if where != "under way" else ""
    return f'<td class="n {role}" title="{escape(where)}">{words}</td>'

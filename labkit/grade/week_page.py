"""A class over several days as one HTML page, with links to the pages of the days."""

from collections.abc import Sequence
from html import escape

from labkit.base import html
from labkit.base.text import count
from labkit.grade.charts import STYLE as PAGE_STYLE
from labkit.grade.charts import Row, chart, legend
from labkit.grade.course import Course, Graded, by_student, percent

ROLES = {  # colours of the states, in the order to list them
    "done": "pass",
    "under way": "line",
    "stuck": "fail",
    "does not load": "broken",
    "not started": "none",
    "ungraded": "dark",
}
MISTAKES = 3  # of each day, the most common
STYLE = PAGE_STYLE + "td.n, th.n { text-align: right; }\n"


def render(courses: Sequence[Course]) -> str:
    """Return the whole page."""
    title = f"Days {courses[0].day.number} to {courses[-1].day.number}"
    class_ = by_student(courses)
    done = sum(all(one.state == "done" for one in days) for days in class_)
    about = f"{count(len(class_), 'student')}; {done:,} passed every task"
    head = "".join(f"<th class=n>{_link(course)}</th>" for course in courses)
    rows = [
        f"<tr><td>{escape(days[0].student.name)}</td>"
        f"<td class=n>{percent(*days) or '?'}</td>{''.join(map(_cell, days))}</tr>"
        for days in class_
    ]
    everybody = html.section(
        "Everybody <small>tasks that pass, by day</small>",
        html.table(
            f"<th>name</th><th class=n>per cent</th>{head}", rows, "card scroll all"
        ),
    )
    return html.page(title, about, _days(courses), everybody, style=STYLE)


def _days(courses: Sequence[Course]) -> str:
    bars, mistakes = [], ""
    for course in courses:
        counts, size = course.counts, len(course.class_)
        parts = [(role, counts[where]) for where, role in ROLES.items()]
        words = f"{counts['done']:,} of {size:,} done"
        bars.append(Row(f"{course.day.number}  {course.day.title}", words, parts, size))
        common = ", ".join(
            f"{escape(mark.id)} <b>{escape(mark.mistake)}</b> ({len(who)})"
            for mark, who in course.mistakes()[:MISTAKES]
        )
        head = f'<div class="head">{_link(course, "Day ")}</div>'
        mistakes += f"<li>{head}<p>{common or 'none'}</p></li>"
    marks = legend((role, escape(where)) for where, role in ROLES.items())
    about = "students by how they stand, day by day"
    return html.section(
        "The days",
        '<div class="two">',
        html.card("How far the class is", marks, chart(bars, about)),
        html.card("Which mistakes were common", f"<ul>{mistakes}</ul>"),
        "</div>",
    )


def _link(course: Course, what: str = "") -> str:
    number = course.day.number
    return f'<a href="day{number}/class.html">{what}{number}</a>'


def _cell(one: Graded) -> str:
    passed, all_ = one.result.score[0], len(one.result.tasks)
    words = f"{passed} of {all_}" if percent(one) else "?"
    role = ROLES[one.state] if one.state != "under way" else ""
    return f'<td class="n {role}" title="{escape(one.state)}">{words}</td>'

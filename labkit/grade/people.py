"""The people of the page: who is stuck, who writes alike, and everyone."""

from html import escape
from urllib.parse import quote

from labkit.base import html
from labkit.base.text import visible
from labkit.grade.charts import STATUS
from labkit.grade.overview import Course, shown_status
from labkit.grade.sheet import Graded, printable

MOST = 100  # groups that are listed


def list_people(heading: str, some: list[Graded], course: Course) -> str:
    """Return who is in one state, by mistake, those who have waited longest first."""
    if not some:
        return ""

    def place(graded: Graded) -> tuple[str, str, int]:
        first = graded.result.first_mistake
        what = (first.id, first.mistake) if first else ("", "")
        return (*what, -(10**9 if graded.minutes is None else graded.minutes))

    oldest = sorted(some, key=place)
    rows = "".join(_person(graded, course) for graded in oldest)
    return _listed(heading, len(some), "", rows)


def _listed(heading: str, size: int, about: str, rows: str, rest: str = "") -> str:
    says = f'<p class="muted">{about}</p>' if about else ""
    return html.section(
        f"{heading} <small>{size:,}</small>",
        f'<div class="card">{says}<ul>{rows}</ul>{rest}</div>',
    )


def _person(graded: Graded, course: Course) -> str:
    mistake = graded.result.first_mistake
    badge, says = "", graded.error
    if mistake:
        role = "limit" if mistake.status == "close" else "fail"
        name = escape(f"{mistake.id} {mistake.mistake}")
        badge = f'<span class="badge {role}">{name}</span>'
        says = mistake.message
    elif stop := graded.result.stopped_at:
        badge = f'<span class="badge none">{escape(stop.id)}</span>'
    words = f'<p class="says">{escape(says)}</p>' if says else ""
    commit = _ago(graded.minutes, course.deadline)
    return (
        f'<li><div class="head"><b>{_name(graded)}</b>{badge}'
        f'<span class="muted">{commit}</span></div>{words}</li>'
    )


def _name(graded: Graded) -> str:
    """Return a student's name, which leads to their feedback."""
    student = graded.student
    name = escape(student.name)
    if graded.feedback:
        address = quote(f"feedback/{graded.feedback}.txt".encode())
        name = f'<a href="{address}">{name}</a>'
    folder = visible(printable(student.folder), 120)
    if student.name == folder:
        return name
    return f'{name} <span class="muted">{escape(folder)}</span>'


def _ago(minutes: int | None, deadline: bool) -> str:
    if minutes is None:
        return "no commit"
    size = abs(minutes)
    for unit, length in (("d", 1440), ("h", 60), ("min", 1)):
        if size >= 2 * length or length == 1:
            when = f"{size // length} {unit}"
            break
    side = "after" if minutes < 0 else "before"
    moment = "the deadline" if deadline else "grading"
    return f"last commit {when} {side} {moment}, they say"


def list_alike(course: Course) -> str:
    """Return the similar submissions, as a hint."""
    if not course.alike:
        return ""
    by_folder = {g.student.folder: g for g in course.class_}
    rows = "".join(
        '<li><div class="head"><span>'
        + ("the kit's solution, " if group.with_kit else "")
        + ", ".join(f"<b>{_name(by_folder[key])}</b>" for key in group.keys)
        + f'</span><span class="muted">{group.share:.0%} alike</span></div></li>'
        for group in course.alike[:MOST]
    )
    more = len(course.alike) - MOST
    rest = f'<p class="muted">and {more:,} more</p>' if more > 0 else ""
    about = (
        "A hint of where to look, not a "
        "verdict: friends who learn together and a good book also write alike. The "
        "starter's text and what much of the class writes are left out; names do not "
        "count. The number is that of the two most similar; beside the kit's solution, "
        "the share of one's own code that stands in it."
    )
    return _listed("Similar submissions", len(course.alike), about, rows, rest)


def list_refused(course: Course) -> str:
    """Return what the code of some wanted and was refused, whatever its marks are."""
    some = [graded for graded in course.class_ if graded.result.refused]
    if not some:
        return ""
    rows = "".join(
        f'<li><div class="head"><b>{_name(graded)}</b></div>'
        f'<p class="says">{escape("; ".join(graded.result.refused))}</p></li>'
        for graded in some[:MOST]
    )
    about = "A task needs nothing but its arguments. Most of these are accidents: ask."
    return _listed("What the sandbox refused", len(some), about, rows)


def table(course: Course) -> str:
    """Return everyone's tasks and deliverables, a mark each."""
    first = course.class_[0].result
    names = ["tasks", *(mark.id for mark in (*first.tasks, *first.items)), "commit is"]
    head = "".join(f'<th class="mark">{escape(name)}</th>' for name in names)
    body = (_line(graded, course.deadline) for graded in course.class_)
    return html.section(
        "Everyone",
        '<p class="muted wider">The table is wider than the '
        "screen: move it sideways.</p>",
        html.table(f"<th>name</th>{head}", body, "card scroll all"),
    )


def _line(graded: Graded, deadline: bool) -> str:
    result = graded.result
    cells = [f'<td class="mark">{graded.tasks_passed}/{len(result.tasks)}</td>']
    for mark in (*result.tasks, *result.items):
        role, sign, word = STATUS[shown_status(graded, mark)]
        tip = escape(f"{mark.id}: {mark.mistake or word}")
        cells.append(f'<td class="mark {role}" title="{tip}">{sign}</td>')
    when = "–" if graded.minutes is None else "in time"
    if deadline and graded.minutes is not None and graded.minutes < 0:
        when = '<span class="fail">late</span>'
    cells.append(f'<td class="mark">{when if deadline else "–"}</td>')
    return f"<tr><td>{_name(graded)}</td>{''.join(cells)}</tr>"

"""The people of the page: who is stuck, who writes alike, and everyone."""

from html import escape

from robo47.grading.course import Course
from robo47.grading.look import STATUS
from robo47.grading.sheet import Graded

MOST = 100  # groups that are listed


def list_people(heading: str, some: list[Graded], course: Course) -> str:
    """Return who is in one state, those who have waited longest first."""
    if not some:
        return ""
    oldest = sorted(some, key=lambda g: -(10**9 if g.minutes is None else g.minutes))
    rows = "".join(_person(graded, course) for graded in oldest)
    return (
        f"<section><h2>{heading} <small>{len(some):,}</small></h2>"
        f'<div class="card"><ul>{rows}</ul></div></section>'
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
    student = graded.student
    if student.name == student.folder:
        return escape(student.name)
    return f'{escape(student.name)} <span class="muted">{escape(student.folder)}</span>'


def _ago(minutes: int | None, deadline: bool) -> str:
    if minutes is None:
        return "no commit"
    size = abs(minutes)
    for unit, length in (("d", 1440), ("h", 60), ("min", 1)):
        if size >= 2 * length or length == 1:
            when = f"{size // length} {unit}"
            break
    side = "after" if minutes < 0 else "before"
    return f"last commit {when} {side} {'the deadline' if deadline else 'grading'}"


def list_alike(course: Course) -> str:
    """Return the similar submissions, as a hint."""
    if not course.alike:
        return ""
    by_folder = {g.student.folder: g for g in course.class_}
    rows = "".join(
        '<li><div class="head"><span>'
        + ", ".join(f"<b>{_name(by_folder[key])}</b>" for key in group.keys)
        + f'</span><span class="muted">{group.share:.0%} alike</span></div></li>'
        for group in course.alike[:MOST]
    )
    more = len(course.alike) - MOST
    rest = f'<p class="muted">and {more:,} more</p>' if more > 0 else ""
    return (
        f"<section><h2>Similar submissions <small>{len(course.alike):,}</small>"
        '</h2><div class="card"><p class="muted">A hint of where to look, not a '
        "verdict: friends who learn together and a good book also write alike. The "
        "starter's text and what much of the class writes are left out; names do not "
        "count. The number is that of the two most similar.</p>"
        f"<ul>{rows}</ul>{rest}</div></section>"
    )


def table(course: Course) -> str:
    """Return everyone's tasks and deliverables, a mark each."""
    first = course.class_[0].result
    names = [mark.id for mark in (*first.tasks, *first.items)]
    head = "".join(f'<th class="mark">{escape(name)}</th>' for name in names)
    body = "".join(_line(graded) for graded in course.class_)
    return (
        '<section><h2>Everyone</h2><div class="card scroll"><table>'
        f"<tr><th>name</th>{head}</tr>{body}</table></div></section>"
    )


def _line(graded: Graded) -> str:
    cells = []
    for mark in (*graded.result.tasks, *graded.result.items):
        role, sign, word = STATUS[mark.status]
        tip = escape(f"{mark.id}: {mark.mistake or word}")
        cells.append(f'<td class="mark {role}" title="{tip}">{sign}</td>')
    return f"<tr><td>{_name(graded)}</td>{''.join(cells)}</tr>"

"""A class as one HTML file, a day or several: no script, no font, no net is needed."""

import time
from collections import Counter
from collections.abc import Sequence
from html import escape
from urllib.parse import quote

from labkit.base import html
from labkit.base.text import count, visible
from labkit.check.memory import first_sentence
from labkit.grade.charts import STATUS, STYLE, Row, chart, legend
from labkit.grade.course import UNKNOWN, Course, GradedStudent, by_student, percent
from labkit.grade.result import Mark
from labkit.grade.sheet import printable
from labkit.report.generic_verdicts import UNNAMED

CHARTED = 15  # mistakes in the chart
COMMON = 3  # mistakes shown per day, the most frequent first
MOST = 100  # groups that are listed
STATES = {  # heading of a list of people
    "stuck": "Who is stuck",
    "does not load": "Files that do not load",
    "elsewhere": "Work that is not in its place",
    "ungraded": "Could not be graded",
    "not started": "Not started",
    "under way": "Under way, without a mistake so far",
}
ROLES = {  # colours of the states, in the order to list them
    "done": "pass",
    "under way": "line",
    "stuck": "fail",
    "does not load": "broken",
    "elsewhere": "broken",
    "not started": "none",
    "ungraded": "dark",
}
NUMBERS = "td.n, th.n { text-align: right; }\n"
_ALIKE = (
    "These groups are a hint where to look and no verdict, because friends who learn "
    "together and readers of one book also write similar code. The comparison ignores "
    "names, the text of the starter, and code that much of the class has written. The "
    "percentage belongs to the two most similar submissions. Next to the kit's "
    "solution, it is the fraction of the student's own code that the solution "
    "contains, or of the solution's functions that the student's code contains."
)
_GROUPS = '<a href="#alike">groups alike</a>: no verdict'
_HIDDEN = (
    "An ordinary file has a def for each function of a task. In these files, a task "
    "passes without one, or next to code that executes a text, or next to long text "
    "constants that could be code. Read the file, and ask the student."
)
_COUNTED = (
    "Each mistake is counted once per student, in the task where it was made. A full "
    "bar is the whole class. Mistakes without a name come last."
)
_REFUSED = (
    "A task needs only its arguments. Most of these are accidents: ask the student."
)


def render(course: Course) -> str:
    """Return the page of a day."""
    return html.page(
        f"Day {course.day.number}: {escape(course.day.title)}",
        _about(course),
        _tiles(course),
        _mistakes(course),
        _standings(course),
        *(_people(course, state) for state in STATES),
        _similar(course),
        _hidden(course),
        _refused(course),
        _everyone(course),
        style=STYLE,
    )


def _about(course: Course) -> str:
    moment = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(course.reference))
    what = "deadline" if course.deadline else "first graded"
    kits = sorted({g.result.kit for g in course.class_} - {""})
    return (
        f"{count(len(course.class_), 'student')}; {what} {moment}; "
        f"robo47 {escape(', '.join(kits) or 'has graded nobody')}, seed {course.seed}. "
        "The times of commits come from the students' clocks, which they can set."
    )


def _tiles(course: Course) -> str:
    number = course.counts
    tiles = [
        ("pass", number["done"], "all tasks passed"),
        ("", number["under way"], "under way"),
        ("fail" if number["stuck"] else "none", number["stuck"], "stuck"),
        ("broken", number["does not load"], "do not load"),
        *(
            [("broken", number["elsewhere"], "not in place")]
            * bool(number["elsewhere"])
        ),
        ("none", number["not started"], "not started"),
        ("limit" if number["ungraded"] else "none", number["ungraded"], "not graded"),
        ("", len(course.alike), _GROUPS if course.alike else "groups alike"),
    ]
    return html.tiles((role, f"{number:,}", label) for role, number, label in tiles)


def _mistakes(course: Course) -> str:
    """Return what to explain again: a chart, and the words that the students saw."""
    found = course.mistakes()
    if not found:
        return ""
    size = len(course.class_)
    rows = []
    words = []
    for mark, who in found:
        students = f"{len(who):,} of {count(size, 'student')}"
        parts = [("line", len(who))]
        name = _name_of(mark.mistake)
        rows.append(Row(f"{mark.id}  {name}", students, parts, size))
        head = f"{escape(mark.id)} <b>{escape(name)}</b>, {students}"
        says = f'<p class="says">{escape(mark.message)}</p>'
        names = f'<p class="muted">{", ".join(map(escape, who))}</p>'
        words.append(html.folded(head, says, names))
    if others := words[CHARTED:]:
        words[CHARTED:] = [html.folded("the others", *others)]
    kinds = "1 mistake" if len(found) == 1 else f"{len(found)} different mistakes"
    rest = f", the {CHARTED} most common" if others else ""
    counted = f'<p class="muted">{_COUNTED}</p>'
    bars = chart(rows[:CHARTED], "students by mistake, the most common first")
    return html.section(
        "What to explain again tomorrow",
        '<div class="two">',
        html.card(f"{kinds}{rest}", counted, bars),
        html.card("The sentences that the students read", *words),
        "</div>",
    )


def _name_of(mistake: str) -> str:
    """Return a mistake's name as the catalogue has it, or words where it has none."""
    return UNNAMED.get(mistake, mistake)


def _standings(course: Course) -> str:
    """Return how many pass each task and each deliverable, and how many stopped there.

    Only who has begun, with a file that loads, has stopped somewhere.
    """
    results = [graded.result for graded in course.class_]
    stops = Counter(
        mark.id
        for graded in course.class_
        if graded.state in ("stuck", "under way")
        if (mark := graded.result.stopped_at)
    )
    labels = {t.id: f"{t.id}  {', '.join(t.functions)}" for t in course.day.tasks}
    marks = legend((role, word) for role, _, word in STATUS.values())

    def row(column: Sequence[Mark]) -> Row:
        id = column[0].id
        number = Counter(mark.shown for mark in column)
        words = f"{number['passed']} pass"
        words += f", {stops[id]} stopped here" if stops[id] else ""
        parts = [(role, number[status]) for status, (role, *_) in STATUS.items()]
        return Row(labels.get(id, id), words, parts, len(column))

    def card(heading: str, groups: Sequence[Sequence[Mark]]) -> str:
        rows = [row(column) for column in zip(*groups, strict=True)]
        return html.card(heading, marks, chart(rows, heading))

    return html.section(
        "The tasks that stop students",
        '<div class="two">',
        card("Tasks", [result.tasks for result in results]),
        card("Deliverables", [result.items for result in results]),
        "</div>",
    )


def _people(course: Course, state: str) -> str:
    """Return who is in one state, by mistake, those who have waited longest first."""

    def place(graded: GradedStudent) -> tuple[str, str, int]:
        first = graded.result.first_mistake
        what = (first.id, first.mistake) if first else ("", "")
        return (*what, -(10**9 if graded.minutes is None else graded.minutes))

    some = sorted((g for g in course.class_ if g.state == state), key=place)
    return _listed(STATES[state], len(some), list(map(_person, some)))


def _person(graded: GradedStudent) -> str:
    mistake = graded.result.first_mistake
    badge = ""
    says = graded.error
    if mistake:
        role = "limit" if mistake.status == "close" else "fail"
        name = escape(f"{mistake.id} {mistake.mistake}")
        badge = f'<span class="badge {role}">{name}</span>'
        says = mistake.message
    elif stop := graded.result.stopped_at:
        badge = f'<span class="badge none">{escape(stop.id)}</span>'
    commit = f'<span class="muted">{_ago(graded)}</span>'
    return _entry(f"<b>{_name(graded)}</b>{badge}{commit}", says)


def _listed(
    heading: str,
    size: int,
    rows: Sequence[str],
    about: str = "",
    rest: str = "",
    id: str = "",
) -> str:
    """Return a section with a list; "" of nobody."""
    if not rows:
        return ""
    says = f'<p class="muted">{about}</p>' if about else ""
    return html.section(
        f"{heading} <small>{size:,}</small>",
        f'<div class="card">{says}<ul>{"".join(rows)}</ul>{rest}</div>',
        id=id,
    )


def _entry(head: str, says: str = "") -> str:
    words = f'<p class="says">{escape(says)}</p>' if says else ""
    return f'<li><div class="head">{head}</div>{words}</li>'


def _name(graded: GradedStudent) -> str:
    """Return a student's name, which leads to their feedback."""
    student = graded.student
    address = quote(f"feedback/{student.file}.txt".encode())
    name = f'<a href="{address}">{escape(student.name)}</a>'
    folder = visible(printable(student.folder), 120)
    if student.name == folder:
        return name
    return f'{name} <span class="muted">{escape(folder)}</span>'


def _ago(graded: GradedStudent) -> str:
    if graded.minutes is None:
        return "last commit: a time that cannot be" if graded.commit else "no commit"
    size = abs(graded.minutes)
    units = (("d", 1440), ("h", 60), ("min", 1))
    unit, length = next((u for u in units if size >= 2 * u[1]), units[-1])
    side = "after" if graded.minutes < 0 else "before"
    moment = "grading" if graded.late is None else "the deadline"
    return (
        f"last commit {size // length} {unit} {side} {moment}, by the student's clock"
    )


def _similar(course: Course) -> str:
    by_folder = {g.student.folder: g for g in course.class_}
    rows = []
    for group in course.alike[:MOST]:
        names = ", ".join(f"<b>{_name(by_folder[key])}</b>" for key in group.keys)
        kits = "the kit's solution, " if group.with_kit else ""
        share = f'<span class="muted">{group.share:.0%} alike</span>'
        rows.append(_entry(f"<span>{kits}{names}</span>{share}"))
    more = len(course.alike) - MOST
    rest = f'<p class="muted">and {more:,} more</p>' if more > 0 else ""
    heading = "Similar submissions"
    return _listed(heading, len(course.alike), rows, _ALIKE, rest, id="alike")


def _hidden(course: Course) -> str:
    """Return who passes with what does not show in their file."""
    some = [graded for graded in course.class_ if graded.hidden]
    rows = [
        _entry(f"<b>{_name(graded)}</b>", "; ".join(graded.hidden))
        for graded in some[:MOST]
    ]
    return _listed("Passes, and does not show in the file", len(some), rows, _HIDDEN)


def _refused(course: Course) -> str:
    """Return what the code of some wanted and was refused, whatever its marks are."""
    some = [graded for graded in course.class_ if graded.result.refused]
    rows = [
        _entry(f"<b>{_name(graded)}</b>", "; ".join(graded.result.refused))
        for graded in some[:MOST]
    ]
    return _listed("What the sandbox refused", len(some), rows, _REFUSED)


def _everyone(course: Course) -> str:
    first = course.class_[0].result
    names = ["tasks", *(mark.id for mark in (*first.tasks, *first.items)), "commit is"]
    head = "".join(f'<th class="mark">{escape(name)}</th>' for name in names)
    body = map(_line, course.class_)
    return html.section(
        "Everyone",
        '<p class="muted wider">The table is wider than the '
        "screen: move it sideways.</p>",
        html.table(f"<th>name</th>{head}", body, "card scroll all"),
    )


def _line(graded: GradedStudent) -> str:
    result, (late, _) = graded.result, graded.late_by
    cells = [f'<td class="mark">{result.score[0]}/{len(result.tasks)}</td>']
    for mark in (*result.tasks, *result.items):
        role, sign, word = STATUS[mark.shown]
        tip = escape(f"{mark.id}: {mark.mistake or word}")
        cells.append(f'<td class="mark {role}" title="{tip}">{sign}</td>')
    when = "–" if late is None else "in time"
    if late == UNKNOWN:
        when = UNKNOWN
    elif late:
        when = '<span class="fail">late</span>'
    cells.append(f'<td class="mark">{when}</td>')
    return f"<tr><td>{_name(graded)}</td>{''.join(cells)}</tr>"


def render_days(courses: Sequence[Course]) -> str:
    """Return the page of several days, with links to the pages of each."""
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
    return html.page(title, about, _days(courses), everybody, style=STYLE + NUMBERS)


def _days(courses: Sequence[Course]) -> str:
    bars = []
    mistakes = ""
    without = []
    for course in courses:
        counts = course.counts
        size = len(course.class_)
        parts = [(role, counts[where]) for where, role in ROLES.items()]
        words = f"{counts['done']:,} of {size:,} done"
        bars.append(Row(f"{course.day.number}  {course.day.title}", words, parts, size))
        common = "".join(
            f"<p>{escape(mark.id)} <b>{escape(_name_of(mark.mistake))}</b> ({len(who)})"
            f' <span class="muted">{escape(first_sentence(mark.message))}</span></p>'
            for mark, who in course.mistakes()[:COMMON]
        )
        if common:
            head = f'<div class="head">{_link(course, "Day ")}</div>'
            mistakes += f"<li>{head}{common}</li>"
        else:
            without.append(_link(course))
    if without:
        head = '<div class="head">Days without one</div>'
        mistakes += f"<li>{head}<p>{', '.join(without)}</p></li>"
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


def _cell(one: GradedStudent) -> str:
    passed = one.result.score[0]
    all_ = len(one.result.tasks)
    words = f"{passed}/{all_}" if percent(one) else "?"
    role = ROLES[one.state] if one.state != "under way" else ""
    return f'<td class="n {role}" title="{escape(one.state)}">{words}</td>'

"""The class as one HTML file that needs nothing else: no script, no font, no net."""

import time
from collections.abc import Callable
from html import escape

from labkit.base import html
from labkit.grade import overview
from labkit.grade.charts import STATUS, STYLE, Row, chart, legend
from labkit.grade.overview import Course, Diagnosis, Standing
from labkit.grade.people import list_alike, list_people, list_refused, table
from labkit.grade.sheet import printable

CHARTED = 15  # diagnoses in the chart
STATES = {  # heading, and what to say where it is nobody
    "stuck": "Who is stuck",
    "does not load": "Files that do not load",
    "ungraded": "Could not be graded",
    "not started": "Not started",
    "under way": "Under way, without a mistake so far",
}


def render(course: Course) -> str:
    """Return the whole page."""
    day, class_ = course.day, course.class_
    by_state = {
        state: [g for g in class_ if overview.state(g) == state]
        for state in (*STATES, "done")
    }
    return printable(
        html.page(
            f"Day {day.number}: {escape(day.title)}",
            _about(course),
            _tiles(course, {state: len(some) for state, some in by_state.items()}),
            _mistakes(overview.diagnoses(day, class_), len(class_)),
            _standings(course),
            *(list_people(STATES[s], by_state[s], course) for s in STATES),
            list_alike(course),
            list_refused(course),
            table(course),
            style=STYLE,
        )
    )


def _about(course: Course) -> str:
    moment = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(course.reference))
    what = "deadline" if course.deadline else "first graded"
    kits = sorted({g.result.kit for g in course.class_} - {""})
    return (
        f"{_students(len(course.class_))}; {what} {moment}; "
        f"robo47 {escape(', '.join(kits) or 'has graded nobody')}, seed {course.seed}. "
        "Commit times are the students' own: whoever commits sets the clock."
    )


def _tiles(course: Course, count: dict[str, int]) -> str:
    tiles = [
        ("pass", count["done"], "all tasks passed"),
        ("", count["under way"], "under way"),
        ("fail" if count["stuck"] else "none", count["stuck"], "stuck"),
        ("broken", count["does not load"], "do not load"),
        ("none", count["not started"], "not started"),
        ("limit" if count["ungraded"] else "none", count["ungraded"], "not graded"),
        ("", len(course.alike), "groups alike"),
    ]
    return html.tiles((role, f"{number:,}", label) for role, number, label in tiles)


def _mistakes(found: list[Diagnosis], size: int) -> str:
    if not found:
        return ""
    shown = found[:CHARTED]
    rows = [
        Row(
            f"{one.task}  {one.mistake}",
            _students(len(one.who)),
            [("line", len(one.who))],
            len(shown[0].who),
        )
        for one in shown
    ]
    bars = chart(rows, "students by mistake, the most common first")
    words = "".join(map(_diagnosis, shown))
    if more := "".join(map(_diagnosis, found[CHARTED:])):
        words += html.folded("the others", more)
    kinds = "1 mistake" if len(found) == 1 else f"{len(found)} different mistakes"
    rest = f", the {CHARTED} most common" if len(found) > CHARTED else ""
    counted = '<p class="muted">Counted where they were made, once per student</p>'
    return html.section(
        "What to explain again tomorrow",
        '<div class="two">',
        html.card(f"{kinds}{rest}", counted, bars),
        html.card("In the words the students saw", words),
        "</div>",
    )


def _diagnosis(one: Diagnosis) -> str:
    who = ", ".join(map(escape, one.who))
    return html.folded(
        f"{escape(one.task)} <b>{escape(one.mistake)}</b>, {_students(len(one.who))}",
        f'<p class="says">{escape(one.example)}</p><p class="muted">{who}</p>',
    )


def _standings(course: Course) -> str:
    functions = {t.id: ", ".join(t.functions) for t in course.day.tasks}
    tasks = overview.standings(course.class_, lambda result: result.tasks)
    items = overview.standings(course.class_, lambda result: result.items)
    marks = legend((role, word) for role, _, word in STATUS.values())

    def card(
        heading: str, some: list[Standing], label: Callable[[Standing], str]
    ) -> str:
        rows = [_standing(one, label(one), len(course.class_)) for one in some]
        return html.card(heading, marks, chart(rows, heading))

    return html.section(
        "Which tasks stop people",
        '<div class="two">',
        card("Tasks", tasks, lambda one: f"{one.id}  {functions[one.id]}"),
        card("Deliverables", items, lambda one: one.id),
        "</div>",
    )


def _standing(one: Standing, label: str, size: int) -> Row:
    words = f"{one.counts['passed']} pass"
    words += f", {one.stopped} stopped here" if one.stopped else ""
    parts = [(role, one.counts[status]) for status, (role, *_) in STATUS.items()]
    return Row(label, words, parts, size)


def _students(number: int) -> str:
    return "1 student" if number == 1 else f"{number:,} students"

"""A class's bug hunt as one HTML file: what to talk about, and who is where."""

from collections import Counter
from collections.abc import Sequence
from html import escape

from labkit.base import html
from labkit.base.text import count
from labkit.grade.charts import STYLE, Row, chart
from labkit.grade.hunts import (
    FOUND,
    NAMED,
    NO_HUNT,
    NOT_FOUND,
    REPAIRED,
    STATES,
    UNGRADED,
    Hunt,
    Hunter,
)
from labkit.grade.sheet import printable

ROLES = {
    FOUND: "pass",
    REPAIRED: "limit",
    NAMED: "line",
    NOT_FOUND: "fail",
    NO_HUNT: "none",
    UNGRADED: "dark",
}
HEAD = ("name", "how it stands", "runs", "checks", "wrong", "suspected", "besides")
ABOUT = (
    "Judged here, by the committed script. Whom they suspected and how many runs they "
    "took is their own word: a file that anybody can edit."
)


def render(hunt: Hunt, hunters: Sequence[Hunter]) -> str:
    """Return the whole page."""
    day = hunt.day
    said = [
        f"{escape(one.function)} <b>{escape(one.slug)}</b>: "
        f"{escape(one.says or 'its numbers say it')}."
        for one in hunt.case.mistakes
    ]
    about = f"{count(len(hunters), 'student')}; level {hunt.level}, seed {hunt.seed}"
    return html.page(
        f"Bug hunt, Day {day.number}: {escape(day.title)}",
        f"{about}. {ABOUT}",
        _tiles(hunters),
        html.section(
            "What was hidden",
            f'<div class="card">{"".join(f"<p>{one}</p>" for one in said)}</div>',
        ),
        _suspected(hunt, hunters),
        _contradictions(hunters),
        _everyone(hunters),
        style=STYLE,
    )


def _tiles(hunters: Sequence[Hunter]) -> str:
    number = Counter(one.state for one in hunters)
    return html.tiles(
        (ROLES[state] if number[state] else "none", f"{number[state]:,}", state)
        for state in STATES
    )


def _suspected(hunt: Hunt, hunters: Sequence[Hunter]) -> str:
    """Return which functions were suspected first: what the symptom looked like."""
    first = Counter(one.suspected[0][0] for one in hunters if one.suspected)
    if not first:
        return ""
    most = first.most_common(1)[0][1]
    guilty = hunt.case.guilty
    rows = [
        Row(
            f"{name}{', the wrong one' if name in guilty else ''}",
            count(number, "student"),
            [("pass" if name in guilty else "fail", number)],
            most,
        )
        for name, number in first.most_common()
    ]
    words = [
        html.folded(
            f"{escape(name)} <small>{len(texts)}</small>",
            *(f'<p class="says">{escape(text)}</p>' for text in texts),
        )
        for name in first
        if (texts := [t for h in hunters for f, t in h.suspected if f == name and t])
    ]
    return html.section(
        "Whom they suspected first",
        '<div class="two">',
        html.card("Functions", chart(rows, "students by the function suspected first")),
        html.card("What they expected to see", *words) if words else "",
        "</div>",
    )


def _contradictions(hunters: Sequence[Hunter]) -> str:
    rows = [
        f'<li><div class="head"><b>{escape(printable(one.student.name))}</b></div>'
        f'<p class="says">{escape("; ".join(one.odd))}</p></li>'
        for one in hunters
        if one.odd
    ]
    if not rows:
        return ""
    why = "Most of these are accidents, such as a row that was not committed: ask."
    return html.section(
        f"Look at <small>{len(rows)}</small>",
        f'<div class="card"><p class="muted">{why}</p><ul>{"".join(rows)}</ul></div>',
    )


def _everyone(hunters: Sequence[Hunter]) -> str:
    head = "".join(f"<th>{name}</th>" for name in HEAD)
    rows = []
    for one in hunters:
        besides = one.why or one.said
        if one.innocent:
            besides = f"right, and written anew: {', '.join(one.innocent)}. {besides}"
        cells = (
            escape(printable(one.student.name)),
            f'<span class="{ROLES[one.state]}">{one.state}</span>',
            str(one.runs or "–"),
            str(one.checks or "–"),
            str(one.wrong or "–"),
            escape(", ".join(function for function, _ in one.suspected) or "–"),
        )
        inner = "".join(f"<td>{cell}</td>" for cell in cells)
        rows.append(f"<tr>{inner}<td class=note>{escape(besides)}</td></tr>")
    return html.section("Everyone", html.table(head, rows, "card scroll all"))

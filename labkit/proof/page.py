"""The proof as one HTML file; the only script in it is the film's player."""

import datetime
import secrets
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from types import ModuleType
from typing import Any

import mujoco

import robo47
from labkit.base import html
from labkit.base.text import count, number_of
from labkit.check.lab_run import TRIALS
from labkit.check.own_functions import OwnCount, counted
from labkit.proof import sharing
from labkit.proof.capstone import Attempt, recorded
from labkit.proof.facts import RunDay
from labkit.report import overview, prediction_plot
from labkit.report.series import Series, cell_of, limit_of, with_unit
from robo47.attempt import Summary

# Viser's player needs this in the page's policy: its workers compile their code.
ALLOWED = (
    "; script-src 'nonce-{nonce}' 'unsafe-eval'; worker-src blob:; font-src data:"
    "; img-src data: blob:; connect-src data: blob:"
)
STYLE = """
body { max-width: 980px; } td.n, th.n { text-align: right; }
td.wide { white-space: normal; min-width: 140px; }
iframe { display: block; width: 100%; height: min(70vh, 560px); border: 0; }
.film { padding: 0; overflow: hidden; margin-bottom: 12px; } li { margin: 4px 0; }
@media (max-width: 500px) { .card { padding: 10px; }
  th, td { padding-right: 8px; white-space: normal; overflow-wrap: normal; }
  td.wide { min-width: 120px; overflow-wrap: anywhere; }
  .film { padding: 0; } iframe { height: 420px; } }
"""
WORTH = {
    "pass": ("pass", "by the present file"),
    "fail": ("fail", "beyond its limit"),
    "none": ("none", "not in the student's log"),
    "kit": ("none", "not in the student's log"),
    "stale": ("none", "the file has changed since"),
    "unsigned": ("none", "by an unknown file"),
    "borrowed": ("none", "partly borrowed"),
}
NOT_PROVED = (
    "Who wrote the code. Anyone can set the name and the time of a commit.",
    "That the student understood it. Ask for explanations; the worksheets contain the"
    " drawings and the answers.",
    "That a real arm would succeed. The arm is a simulation with a known model.",
    "That nobody has edited this page. Run the commit yourself: make fresh.",
)


@dataclass(frozen=True)
class Proof:
    """All that the page says."""

    name: str  # the student's name as one safe line; "" if none is known
    own: bool  # the reader's own, and not a student's
    commit: str  # the hash of the last one, or of those that ran; "" without one
    days: Sequence[RunDay]  # the days of the week, in order
    attempt: Attempt  # the attempt at the capstone
    # The last result of `make fresh`: commit, date, the number of wrong numbers and of
    # missing things; {} if there is none.
    fresh: dict[str, Any] = field(default_factory=dict)


def render(proof: Proof, card_name: str = "") -> str:
    """Return the whole page.

    Args:
        proof: what it says.
        card_name: of the picture to share, a file beside it; "" without one.

    The film is put in last and by a name that nobody could know before: no text from
    outside can stand in its place, and no script runs but with its number.
    """
    nonce = secrets.token_urlsafe(16)
    place = f"film {nonce}"
    week = proof.days[0].day.week.heading
    heading = f"{proof.name}, {week}" if proof.name else week
    title = escape(heading)
    who = "the student's own kit" if proof.own else "a teacher's kit"
    not_proved = "".join(f"<li>{escape(line)}</li>" for line in NOT_PROVED)
    page = html.page(
        title,
        f"Run by {who} on {datetime.date.today()}: robo47 {robo47.__version__}, MuJoCo"
        f" {mujoco.__version__}. Every function ran in a sandbox, none was trusted.",
        _tiles(proof),
        _capstone(proof.attempt, place),
        _numbers(proof.days),
        _predictions(proof.days),
        _functions(proof.days),
        _commit(proof),
        html.section("What this does not prove", f"<ul>{not_proved}</ul>"),
        style=STYLE + overview.MARGINS,
        policy=ALLOWED.format(nonce=nonce),
        meta=sharing.meta(card_name, in_short(proof)) if card_name else "",
    )
    told = proof.attempt
    if told.capstone is None or told.result is None:
        return page
    film = recorded(told.capstone.film(told.result))
    played = escape(film.page(_heading(told.capstone), nonce))
    return page.replace(place, played, 1)


def in_short(proof: Proof) -> dict[str, Any]:
    """Return what the door says of the page: texts, and the week's number."""
    week = proof.days[0].day.week
    numbers = [_again(one, number) for one in proof.days for number in one.numbers]
    return {
        "week": week.number,
        "heading": week.heading,
        "name": proof.name,
        "functions": str(_counted(proof)),
        "numbers": f"{sum(r == 'pass' for r, _ in numbers)} of {len(numbers)}",
        "capstone": _capstone_in_short(proof.attempt),
        "date": str(datetime.date.today()),
    }


def _tiles(proof: Proof) -> str:
    numbers = [_again(one, number) for one in proof.days for number in one.numbers]
    right = sum(role == "pass" for role, _ in numbers)
    own = _counted(proof)
    fresh, mood = _fresh(proof)
    return html.tiles([
        ("pass" if own.all else "", str(own), "functions by the student"),
        (
            "pass" if right == len(numbers) else "",
            f"{right} of {len(numbers)}",
            "numbers, computed again",
        ),
        *_capstone_tiles(proof.attempt),
        (mood, fresh, "a fresh clone"),
    ])  # fmt: skip


def _counted(proof: Proof) -> OwnCount:
    """Return how many of the week's functions are theirs."""
    tasks = {one.day.number: one.day.tasks for one in proof.days}
    asked = {day: [f for t in some for f in t.functions] for day, some in tasks.items()}
    return counted(asked, {one.day.number: one.own for one in proof.days})


def _again(one: RunDay, number: Series) -> tuple[str, str]:
    """Return what the lab gave here, after the class of its colour."""
    wanted = number.wanted
    value = one.again.get((wanted.check, wanted.metric))
    if value is None:
        return "none", "–"
    return "pass" if wanted.passes(value) else "fail", with_unit(value, wanted)


def _fresh(proof: Proof) -> tuple[str, str]:
    """Return what a fresh clone of the last commit gave, and its colour's class."""
    if not proof.fresh or proof.fresh.get("commit") != proof.commit:
        return "not tried", "none"
    wrong = proof.fresh.get("wrong")
    return ("same numbers", "pass") if wrong == 0 else ("not the same", "fail")


def _heading(capstone: ModuleType) -> str:
    """Return what a capstone is called, with a capital letter."""
    return f"{capstone.NAME[0].upper()}{capstone.NAME[1:]}"


def _capstone_tiles(attempt: Attempt) -> list[tuple[str, str, str]]:
    """Return the capstone's tile, of a week that has one."""
    if attempt.capstone is None:
        return []
    if attempt.result is None:
        return [("none", "–", attempt.capstone.NAME)]
    told = attempt.capstone.summary(attempt.result)
    role = "pass" if attempt.counted.all else ""
    return [("fail" if attempt.result.failed else role, told.number, told.of)]


def _capstone_in_short(attempt: Attempt) -> str:
    """Return "the pick: 0.9 mm from the cube to its mark", "" without a result."""
    if attempt.capstone is None or attempt.result is None:
        return ""
    told = attempt.capstone.summary(attempt.result)
    words = f"{attempt.capstone.NAME}: {told.number} {told.of}"
    whose = f", with {attempt.counted} functions their own"
    return words if attempt.counted.all else words + whose


def _capstone(attempt: Attempt, place: str) -> str:
    if attempt.capstone is None:
        return ""
    heading = escape(_heading(attempt.capstone))
    own = attempt.counted
    whose = f"{own.own} of the {own.of} functions that it calls are the student's"
    if not own.all:
        whose += "; the kit's own do the rest"
    if attempt.result is None:
        why = f"It stopped: {escape(attempt.stopped)}." if attempt.stopped else ""
        words = why or "None of the functions that move the arm is the student's yet."
        return html.section(heading, f"<p>{words}</p>")
    told = attempt.capstone.summary(attempt.result)
    by = _by(attempt.capstone.USES, attempt)
    words = escape(
        f"{told.came} {whose}. {told.way} Drag the picture to rotate the view."
    )
    player = (
        f'<iframe title="{heading} in 3D" sandbox="allow-scripts" srcdoc="{place}">'
    )
    film = f'<div class="card film">{player}</iframe></div>'
    stayed = _stayed(attempt)
    return html.section(heading, f"<p>{words}</p>", stayed, film, _figures(told), by)


def _figures(told: Summary) -> str:
    """Return what the capstone measured, each with its unit and what is allowed."""
    rows = [
        f"<tr><td class=wide>{escape(what)}</td><td class=n>{escape(value)}</td>"
        f"<td>{escape(limit) or '–'}</td></tr>"
        for what, value, limit in told.figures
    ]
    head = "<th>measured</th><th class=n>here</th><th>allowed</th>"
    return html.table(head, rows) if rows else ""


def _by(uses: Mapping[int, Sequence[str]], attempt: Attempt) -> str:
    """Return whose each of the capstone's functions was in it, by day."""
    rows = []
    for day, names in sorted(uses.items()):
        own = _code([name for name in names if name in attempt.theirs])
        kits = _code([name for name in names if name not in attempt.theirs])
        rows.append(
            f"<tr><td>{day}</td><td class=wide>{own or '–'}</td>"
            f"<td class=wide>{kits or '–'}</td></tr>"
        )
    head = "<th>day</th><th>the student's</th><th>the kit's</th>"
    return html.folded(
        "The functions of the student and of the kit", html.table(head, rows)
    )


def _stayed(attempt: Attempt) -> str:
    """Return which of their functions the sandbox could not call, and what ran."""
    if not attempt.stayed:
        return ""
    return (
        "<p class=muted>By the student, but not run here:"
        f" {_code(sorted(attempt.stayed))}."
        " They query a world that cannot be sent into the sandbox, so the kit's own"
        " functions ran in their place. They pass the check.</p>"
    )


def _begun(days: Sequence[RunDay]) -> list[RunDay]:
    return [one for one in days if set(one.states.values()) != {"not begun"}]


def _margins(days: Sequence[RunDay]) -> str:
    """Return how far each number that was run again is inside its limit."""
    bars = []
    for one in days:
        for number in one.numbers:
            wanted = number.wanted
            value = one.again.get((wanted.check, wanted.metric))
            bars.append(overview.Bar(number, value, _again(one, number)[0]))
    return overview.margins(bars)


def _numbers(days: Sequence[RunDay]) -> str:
    days = _begun(days)
    rows = [_number(one, number) for one in days for number in one.numbers]
    faults = "".join(
        f"<p class=fail>Day {one.day.number}, the lab here: {escape(one.fault)}</p>"
        for one in days
        if one.fault
    )
    faults += "".join(
        f"<p>Day {one.day.number}: {escape(one.unfinished)}</p>"
        for one in days
        if one.unfinished
    )
    head = "<th>day</th><th>number</th><th class=n>run again</th><th>limit</th>"
    about = (
        f'<p class="muted">The day\'s lab ran again with the functions of the student,'
        f" with {TRIALS} random inputs a step. Below each number is the one that the"
        " student's own run logged.</p>"
    )
    table = html.table(head, rows) if rows else "<p>No day was begun.</p>"
    return html.section("The numbers", about, faults, _margins(days), table)


def _number(one: RunDay, number: Series) -> str:
    role, worth = WORTH[number.status]
    logged = "" if number.latest is None else f"log: {number_of(number.latest)}, "
    again, value = _again(one, number)
    return (
        f"<tr><td>{one.day.number}</td>"
        f"<td class=wide>{cell_of(one.day, number.wanted)}<br>"
        f'<small class="{role}">{logged}{worth}</small></td>'
        f'<td class="n {again}">{value}</td><td>{limit_of(number.wanted)}</td></tr>'
    )


def _predictions(days: Sequence[RunDay]) -> str:
    """Return what was predicted and measured, a card for each day that has it."""
    drawn = {one.day.number: prediction_plot.draw(one.worksheet) for one in days}
    cards = [
        html.card(f"Day {day}", picture) for day, picture in drawn.items() if picture
    ]
    if not cards:
        return ""
    about = (
        '<p class="muted">From their worksheets, in which <code>make run</code> writes'
        " the measured number next to a prediction. Nothing here was run again.</p>"
    )
    inner = f'<div class="cards">{"".join(cards)}</div>'
    return html.section("Predicted and measured", about, inner)


def _functions(days: Sequence[RunDay]) -> str:
    rows = []
    for one in _begun(days):
        others: dict[str, list[str]] = {}
        for task in one.day.tasks:
            if (state := one.states[task.id]) != "passed":
                others.setdefault(state, []).extend(task.functions)
        rest = "<br>".join(
            f"{escape(state)}: {_code(names)}" for state, names in others.items()
        )
        rows.append(
            f"<tr><td>{one.day.number}</td><td class=wide>{_code(one.own) or '–'}</td>"
            f"<td class=wide>{rest or '–'}</td></tr>"
        )
    head = "<th>day</th><th>the student's, and correct</th>"
    head += "<th>not the student's, or not correct</th>"
    return html.section("Whose functions", html.table(head, rows))


def _code(names: Sequence[str]) -> str:
    return ", ".join(f"<code>{escape(name)}</code>" for name in names)


def _commit(proof: Proof) -> str:
    if not proof.commit:
        return html.section("The commit", "<p>Nothing is committed.</p>")
    which = "The last commit" if proof.own else "What ran is of commit"
    words = [f"<p>{which}: <code>{escape(proof.commit)}</code>.</p>"]
    left = [
        f"Day {one.day.number}: {one.left.rstrip('.')}"
        for one in _begun(proof.days)
        if one.left
    ]
    if left:
        words.append(f"<p>{escape('; '.join(left))}.</p>")
    else:
        words.append(
            "<p>It contains all files of the days that were begun, as they ran"
            " here.</p>"
        )
    found, mood = _fresh(proof)
    if mood == "none":
        words.append("<p>It was not run in a fresh clone: <code>make fresh</code>.</p>")
    else:
        lacks = proof.fresh.get("missing")
        things = f"; {count(lacks, 'thing')} of the hand-in missing" if lacks else ""
        words.append(
            f'<p class="{mood}">A fresh clone of it was run on'
            f" {escape(str(proof.fresh.get('date')))}: {found}{things}.</p>"
        )
    return html.section("The commit", *words)

"""The entries of a row that the machine names by itself, so that they can be deleted.

An entry is judged as a student's function, first without all entries of its row, then
without those alone that the machine names: this is what is left when they are deleted.
"""

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from labkit.base.exchange import Exchange, Reply
from labkit.judge.answers import own
from labkit.judge.ask import Ask, as_plain, asked_of
from labkit.judge.guard import quiet
from labkit.judge.judge import judge
from labkit.judge.mistake import Verdict
from labkit.judge.row import Row, Way
from labkit.lesson.day import Day
from labkit.sandbox.inside import wire

SEED = 47  # the seed of the sampled inputs


class Told(NamedTuple):
    """An entry, and what a student is told without it."""

    slug: str
    entry: str  # its sentence
    machine: str  # the machine's
    source: str  # "argument", "slip": where the machine's name comes from
    shown: bool  # the sentence shows the mistake, and not only its kind


def told_by_machine(day: Day, row: Row) -> Iterator[Told]:
    """Yield the entries that the machine names when all of these are deleted."""
    full = row.ask
    general = {one.slug for kind in full.kinds for one in kind.general()}
    ways = [way for way in row.named if not way.reached]
    bare = _with_entries(full, ())
    alone = [(way, verdict_on(day, row, way, bare)) for way in ways]
    found = [(way, v) for way, v in alone if _source(v, general)]
    gone = {id(way) for way, _ in found}
    kept = [
        mistake
        for way, mistake in zip(row.named, full.named, strict=True)
        if id(way) not in gone
    ]
    rest = _with_entries(full, kept)
    for way, before in found:
        verdict = verdict_on(day, row, way, rest)
        if verdict.mistake == before.mistake:
            source = _source(verdict, general)
            shown = "`" in verdict.message or source == "kind"
            yield Told(way.slug, way.says, verdict.message, source, shown)


def _with_entries(ask: Ask, mistakes: Sequence[Any]) -> Ask:
    """Return a row with other entries, and what is known of its costs."""
    found = replace(ask, mistakes=mistakes)
    vars(found).update(cost=ask.cost, labs_cost=ask.labs_cost, bodies=ask.bodies)
    return found


def _source(verdict: Verdict, general: set[str]) -> str:
    """Return where a name comes from; "" where it is not the machine's, or of two."""
    slug = verdict.mistake
    if verdict.status != "wrong" or "+" in slug:
        return ""
    begins = ("slip", "argument", "answer-changed")
    return next((b for b in begins if slug.startswith(b)), "kind" * (slug in general))


def verdict_on(day: Day, row: Row, way: Way, ask: Ask) -> Verdict:
    """Return the verdict on one way to write a function, in this process.

    Args:
        day: whose function it is.
        row: of the function.
        way: what stands in its place.
        ask: what is asked.
    """
    asked = asked_of("0.0", row.function, ask, SEED)
    with quiet():
        for one in asked.exchanges:
            one.reply = _reply(way.code, one)
    return judge(asked, text_of(way.code, row.function), row.arguments)


def _reply(code: Callable[..., Any], one: Exchange) -> Reply:
    args = [own(as_plain(arg)) for arg in one.question.args]
    try:
        with np.errstate(all="ignore"):
            value = wire.unpack_value(wire.pack_value(code(*args)))
    except Exception as error:  # a student's function may raise any error
        return Reply(error=str(error), kind=type(error).__name__)
    return Reply(value=value, again=value)


def text_of(code: Callable[..., Any], name: str) -> str:
    """Return an entry's function as a student writes it; "" where it has no text."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(code))).body[0]
    except (OSError, TypeError, SyntaxError):
        return ""
    if not isinstance(tree, ast.FunctionDef):
        return ""
    tree.decorator_list.clear()
    tree.name = name
    return ast.unparse(tree)

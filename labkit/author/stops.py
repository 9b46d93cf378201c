"""Mistakes that stop with an error where their author did not mean it.

A mistake may stop, as a student's function may, and then it names those that stop in
the same calls. But what stops inside the function of a `@row.wrongs` stops all of its
mistakes, so that none of them is recognised; and a name that does not exist is a slip
of the author's.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from labkit.base.text import count
from labkit.judge.answers import own
from labkit.judge.ask import as_plain
from labkit.judge.guard import quiet
from labkit.judge.row import Row, Way
from labkit.judge.written import stop

# What no student's mistake is made for.
SLIPS = (AttributeError, ImportError, KeyError, NameError, NotImplementedError)


def faults_of(row: Row) -> Iterator[str]:
    """Yield the mistakes of a row that stop at a question, and what to do."""
    calls = [*row.ask.main, *row.ask.edges]
    stopped = set[str]()
    with quiet():
        for table in row.tables:
            if found := next(_errors(table.code, calls), None):
                stopped |= table.slugs
                yield (
                    f"its @row.wrongs {stop(found)}, so none of its "
                    f"{count(len(table.slugs), 'mistake')} has an answer to that "
                    "question. Write a mistake that may stop as a function without "
                    "arguments, lambda: ..."
                )
        told = set[str]()
        for way in row.named:
            if way.slug in stopped or way.reached:
                continue
            if (says := _of_one(way, row.ask.main)) and says not in told:
                told.add(says)  # a name that its table lacks stops all others, too
                yield f"its mistake {way.slug} {says}"


def _of_one(way: Way, calls: Sequence[tuple[Any, ...]]) -> str:
    """Return what a mistake stops with that is none of a student's; "" without it."""
    errors = list(_errors(way.code, calls))
    if slip := next((one for one in errors if isinstance(one, SLIPS)), None):
        return stop(slip)
    every = len(errors) == len(calls)
    return f"{stop(errors[0])}, and so at every other question" if every else ""


def _errors(
    code: Callable[..., Any], calls: Sequence[tuple[Any, ...]]
) -> Iterator[Exception]:
    """Yield what a function stops with, call by call."""
    for call in calls:
        try:
            code(*(own(as_plain(arg)) for arg in call))
        except Exception as error:
            yield error

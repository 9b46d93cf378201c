"""The ranges of arguments in the complete lab, and in the questions.

A guard, a clamp or a tolerance of a student's changes what no question asks. So the
complete lab is run, and the smallest and the largest of each argument with which it, or
a later task, calls a function are compared with those of the questions.
"""

import contextlib
import functools
import inspect
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import Any

from labkit.base.quiet import nothing_printed
from labkit.judge.ask import as_plain
from labkit.judge.draw import Draw
from labkit.judge.row import ANY_SIZE, Row, rows_of
from labkit.judge.unusual import size_of
from labkit.lesson.day import Day
from labkit.lesson.lab_module import load_lab

BEYOND = 3.0  # the lab's arguments may be this many times smaller or larger
NOISE = 1e-7  # below it a number of a lab is what rounding leaves
TRIALS = 50  # random inputs of a lab's own comparisons
Range = tuple[float, float]  # the smallest size that is not 0, and the largest


def faults_of(day: Day) -> Iterator[str]:
    """Yield each argument that is smaller or larger in the lab than in any question."""
    for name, argument, size, asked, word in beyond(day):
        yield (
            f"{name}: {argument} is {size:.2g} in the lab, and no question has a value "
            f"{word} {asked:.2g}: name one in row.spans"
        )


def beyond(day: Day) -> Iterator[tuple[str, str, float, float, str]]:
    """Yield function, argument, its size in the lab, and the end that it is beyond."""
    used = uses(day)
    for name, row in rows_of(day).items():
        for argument, (least, most) in used.get(name, {}).items():
            if (asked := _of_questions(row, argument)) is None:
                continue
            low, high = asked
            if least < low / BEYOND:
                yield name, argument, least, low, "below"
            if most > BEYOND * high:
                yield name, argument, most, high, "above"


def uses(day: Day) -> dict[str, dict[str, Range]]:
    """Return, by function and argument, the sizes with which a lab calls its tasks."""
    lab = load_lab(day.source)
    found: dict[str, dict[str, list[float]]] = {}
    for name in [name for task in day.tasks for name in task.functions]:
        vars(lab)[name] = _recorded(vars(lab)[name], found.setdefault(name, {}))
    counts = [k for k in ("TRIALS", "LIBRARY_TRIALS") if hasattr(lab, k)]
    vars(lab).update(dict.fromkeys(counts, TRIALS))
    arguments, sys.argv = sys.argv, [str(day.source), "--no-log"]
    try:
        quiet = nothing_printed(), warnings.catch_warnings(action="ignore")
        # Why a lab stops is told by the part that runs it.
        with quiet[0], quiet[1], contextlib.suppress(Exception, SystemExit):
            lab.main()
    finally:
        sys.argv = arguments
    return {
        name: {k: (min(some), max(some)) for k, some in of.items() if some}
        for name, of in found.items()
    }


def _recorded(function: Callable[..., Any], found: dict[str, list[float]]) -> Any:
    """Return a function that notes the sizes of its arguments."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def called(*args: Any, **named: Any) -> Any:
        with contextlib.suppress(TypeError):
            for name, value in signature.bind(*args, **named).arguments.items():
                if (size := size_of(value)) > NOISE:
                    found.setdefault(name, []).append(size)
        return function(*args, **named)

    return called


def _of_questions(row: Row, argument: str) -> Range | None:
    """Return the sizes of an argument in all questions that every check asks."""
    ask = row.ask
    calls = [*ask.main]
    for held in ask.held_out:
        if held.slug == ANY_SIZE:
            calls += map(tuple, held.inputs(Draw(1)))
    if argument not in row.arguments:
        return None
    k = row.arguments.index(argument)
    sizes = [size for call in calls if (size := size_of(as_plain(call[k])))]
    return (min(sizes), max(sizes)) if sizes else None

"""Run the final task of a week, such as the pick, with your own functions.

    make capstone                       one attempt, with your functions
    make capstone WEEK=1                of week 1
    make capstone ARGS=--all            twenty random ones
    make capstone ARGS=--kit            the library's functions alone
    make capstone ARGS=--ablations      the effects of mistakes, in a table
    make capstone ARGS="--clip a.gif"   a short film of it
    make capstone ARGS="--picture a.png"

The library replaces each function of yours that does not pass `make check`.
"""

import sys
import traceback
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from tqdm import tqdm

from labkit.base import cli
from labkit.base.text import visible
from labkit.check import own_functions
from labkit.lesson.day import chosen_week
from labkit.lesson.predictions import predictions, rows_asked
from labkit.lesson.student_files import retrospectives
from labkit.lesson.week import Week
from robo47.errors import Robo47Error
from robo47.paths import shown

RANDOM = 20
FEW, MANY = 5, 13  # functions that are named, of others' and of one's own
PREDICTED = 3  # rows of the table of mistakes, before it is shown


def chosen(week: Week, kit_only: bool) -> Any:
    """Return the functions to do it with, having said whose they are."""
    if kit_only:
        print("functions: the library's")
        return own_functions.capstone_of(week).library()
    with cli.busy("checking your functions"):
        own = own_functions.load(week)
    uses = own_functions.capstone_of(week).USES
    called = {(day, name) for day, names in uses.items() for name in names}
    theirs = [n for day, some in own.own.items() for n in some if (day, n) in called]
    listed = ": " + ", ".join(theirs) if 0 < len(theirs) < MANY else ""
    counted = own_functions.counted(uses, own.own)
    says = f"{counted.own} of the {counted.of} functions that it calls are yours"
    print(cli.wrapped(says + listed, "  "))
    reasons: dict[str, list[tuple[int, str]]] = {}
    for day, name, why in own.replaced:
        if (day, name) in called:
            reasons.setdefault(why, []).append((day, name))
    for why, some in reasons.items():
        names = [name for _, name in some]
        listed = ", ".join(names) if len(names) < FEW else f"{len(names)} functions"
        days = days_of([day for day, _ in some])
        says = f"  {days}, the library's instead of {listed}: {why}"
        print(cli.wrapped(says, "    "))
    return own.functions


def days_of(numbers: Sequence[int]) -> str:
    """Return "day 3", or "days 1 to 7, 11", of numbers in order."""
    runs: list[list[int]] = []
    for number in dict.fromkeys(numbers):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    said = [
        f"{r[0]} to {r[-1]}" if len(r) > 2 else ", ".join(map(str, r)) for r in runs
    ]
    return f"day{'s' if len(runs) > 1 or len(runs[0]) > 1 else ''} {', '.join(said)}"


def attempted(capstone: ModuleType, fns: Any, *seed: int, **options: Any) -> Any:
    """Attempt it once; a function that stops is told in a line.

    Raises:
        Robo47Error: one of the functions raised an exception.
    """
    try:
        return capstone.attempt(fns, *seed, **options)
    except Robo47Error:
        raise
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        line = f"{Path(last.filename).name}, line {last.lineno}"
        raise Robo47Error(
            f"the arm stopped: {type(error).__name__}: {error} ({line}). "
            "To compare: make capstone ARGS=--kit"
        ) from None


def verdict(capstone: ModuleType, failed: int, count: int) -> int:
    """Say how many arrived; return the exit code."""
    return cli.conclude(not failed, f"{count - failed} of {count} {capstone.GOAL}")


def random_ones(capstone: ModuleType, fns: Any) -> int:
    """Attempt twenty random ones."""
    print(capstone.HEAD)
    failed = 0
    several = f"{capstone.THING}s"
    for seed in tqdm(range(RANDOM), several, leave=False, disable=None):
        result = attempted(capstone, fns, seed)
        failed += result.failed
        line = capstone.row(f"{capstone.THING} {seed + 1}", result)
        tqdm.write(line, file=sys.stdout)
    return verdict(capstone, failed, RANDOM)


def predicted(week: Week) -> dict[str, str]:
    """Return what the student's retrospective predicts, by a row's name."""
    found: dict[str, str] = {}
    for path in retrospectives(week):
        text = path.read_text("utf-8", "replace")
        rows = predictions(text)
        found |= {visible(name).lower(): visible(says) for name, says in rows.items()}
        if rows_asked(text) and len(rows) < PREDICTED:
            print(f"your predictions: {len(rows)} of {PREDICTED} in {shown(path)}")
    return found


def ablations(capstone: ModuleType, fns: Any, week: Week) -> int:
    """Show what a mistake does, below it what was predicted: most still arrive.

    Raises:
        Robo47Error: this capstone has none.
    """
    if not hasattr(capstone, "ablations"):
        raise Robo47Error(f"{capstone.NAME} has no table of mistakes")
    said = predicted(week)
    print(capstone.HEAD)
    for name, (changed, options) in capstone.ablations(fns).items():
        result = attempted(capstone, changed, **options)
        print(capstone.row(name, result), flush=True)
        if name.lower() in said:
            print(f"  you predicted: {said.pop(name.lower())}")
    print(capstone.MORAL)
    for name, says in said.items():
        print(cli.wrapped(f"you predicted {says} of {name!r}: no row has that name"))
    return cli.EXIT_OK


def one(capstone: ModuleType, fns: Any, week: Week, options: Namespace) -> int:
    """Attempt the one that is always the same; film it and draw it where asked to.

    The last line says how to see it, unless a film was written.
    """
    result = attempted(capstone, fns)
    told = capstone.summary(result)
    print("", *told.before, capstone.HEAD, sep="\n")
    print(capstone.row(f"one {capstone.THING}", result), *told.after, sep="\n")
    clip, picture = options.clip, options.picture
    if clip or picture:
        from labkit.figures.clip import film_clip, film_picture

        film = capstone.film(result)
        if picture:
            print(film_picture(film, picture))
        if clip:
            print(film_clip(film, clip))
    code = verdict(capstone, int(result.failed), 1)
    if not clip:
        print(f"To see it: {film_command(capstone, week, options.kit)}")
    return code


def film_command(capstone: ModuleType, week: Week, kit: bool) -> str:
    """Return what to type for a film of the attempt."""
    options = f"{'--kit ' if kit else ''}--clip {capstone.NAME.split()[-1]}.gif"
    return f'make capstone WEEK={week.number} ARGS="{options}"'


def main() -> int:
    """Do what was asked for."""
    parser = cli.parser(__doc__)
    cli.add_week(parser)
    add = parser.add_argument
    add("--all", action="store_true", help="twenty random ones")
    add("--kit", action="store_true", help="the library's functions")
    add("--ablations", action="store_true", help="mistakes, in a table")
    add("--clip", type=Path, metavar="FILE", help="a film (.gif, .webp)")
    add("--picture", type=Path, metavar="FILE", help="a picture (.png)")
    options = parser.parse_args()
    if options.week is None and options.day is None:
        week = own_functions.capstone_week()
    else:
        week = chosen_week(options.week, options.day)
    capstone = own_functions.capstone_of(week)
    fns = chosen(week, options.kit)
    if options.all:
        return random_ones(capstone, fns)
    if options.ablations:
        return ablations(capstone, fns, week)
    return one(capstone, fns, week, options)

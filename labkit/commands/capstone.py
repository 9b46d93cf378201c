"""The capstone of the week: the arm picks the cube up, with your own functions.

    make capstone                       one cube, your functions of all days
    make capstone WEEK=1                of this week; default: the one worked on last
    make capstone ARGS=--all            twenty random cubes
    make capstone ARGS=--kit            the library's functions alone
    make capstone ARGS=--ablations      what mistakes do, in a table
    make capstone ARGS="--clip a.gif"   a short film of it
    make capstone ARGS="--picture a.png"

Each function of yours that `make check` does not pass is replaced by the library's.
"""

import sys
import traceback
from itertools import pairwise
from pathlib import Path
from typing import Any

from tqdm import tqdm

from labkit.base import cli
from labkit.check import own_functions
from labkit.lesson.day import chosen_week
from labkit.lesson.week import Week
from robo47.capstone.phases import Result
from robo47.errors import Robo47Error

CUBES = 20
HEAD = f"""
{"":26}{"place":>8}{"joints":>9}{"line":>8}{"time":>7}{"torque":>8}{"speed":>7}
{"":26}{"mm":>8}{"mrad":>9}{"mm":>8}{"s":>7}{"of max":>8}{"of max":>7}"""


def chosen(week: Week, kit_only: bool) -> Any:
    """Return the functions to do it with, having said whose they are."""
    if kit_only:
        print("functions: the library's")
        return own_functions.capstone_of(week).library()
    with cli.busy("checking your functions"):
        own = own_functions.load(week)
    print(f"yours: {len(own.yours)} of {own.total}")
    for day, why in dict.fromkeys((day, why) for day, _, why in own.replaced):
        names = [name for d, name, w in own.replaced if (d, w) == (day, why)]
        listed = ", ".join(names) if len(names) < 5 else f"{len(names)} functions"
        print(cli.wrapped(f"  day {day}, the library's instead of {listed}: {why}"))
    return own.functions


def row(name: str, result: Result) -> str:
    """Return one line of the table."""
    return (
        f"{name:26}{result.place_mm:8.1f}{result.joint_mrad:9.2f}{result.line_mm:8.1f}"
        f"{result.seconds:7.1f}{result.torque:8.2f}{result.speed:7.2f}"
    )


def pick(capstone: Any, fns: Any, *where: Any, **options: Any) -> Result:
    """Pick once; a function that stops is told in a line.

    Raises:
        Robo47Error: one of the functions raised an exception.
    """
    try:
        return capstone.pick(fns, *where, **options)
    except Robo47Error:
        raise
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        line = f"{Path(last.filename).name}, line {last.lineno}"
        raise Robo47Error(
            f"the arm stopped: {type(error).__name__}: {error} ({line}). "
            "To compare: make capstone ARGS=--kit"
        ) from None


def verdict(failed: int, count: int) -> int:
    """Say how many cubes arrived; return the exit code."""
    return cli.conclude(not failed, f"{count - failed} of {count} placed within 10 mm")


def all_cubes(capstone: Any, fns: Any) -> int:
    """Pick twenty random cubes."""
    print(HEAD)
    failed = 0
    for seed in tqdm(range(CUBES), "cubes", leave=False, disable=None):
        result = pick(capstone, fns, *capstone.random_task(seed))
        failed += result.failed
        tqdm.write(row(f"cube {seed + 1}", result), file=sys.stdout)
    return verdict(failed, CUBES)


def ablations(capstone: Any, fns: Any) -> int:
    """Show what a mistake does: most of them still place the cube."""
    print(HEAD)
    for name, (changed, speed) in capstone.ablations(fns).items():
        print(row(name, pick(capstone, changed, speed=speed)), flush=True)
    print("Placed is no proof: look at the joints and the line.")
    return cli.EXIT_OK


def one_cube(capstone: Any, fns: Any, clip: Path | None, picture: Path | None) -> int:
    """Pick the cube from where it always is; film and picture where they are wanted."""
    result = pick(capstone, fns)
    print()
    for (name, begins), (_, ends) in pairwise([*result.phases, ("", result.seconds)]):
        print(f"  {begins:5.2f} s  {name:9} {ends - begins:5.2f} s")
    print(f"{HEAD}\n{row('one cube', result)}")
    print(f"lifted {1000 * result.lift:.0f} mm; this grip can lift, as predicted,")
    print(f"  {result.heaviest:.3f} kg; the cube has 0.080 kg")
    if clip or picture:
        from labkit.figures.clip import pick_clip, pick_picture

        if picture:
            print(pick_picture(result, picture))
        if clip:
            print(pick_clip(result, clip))
    return verdict(int(result.failed), 1)


def main() -> int:
    """Do what was asked for."""
    parser = cli.parser(__doc__)
    cli.add_week(parser)
    add = parser.add_argument
    add("--all", action="store_true", help="twenty random cubes")
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
        return all_cubes(capstone, fns)
    if options.ablations:
        return ablations(capstone, fns)
    return one_cube(capstone, fns, options.clip, options.picture)

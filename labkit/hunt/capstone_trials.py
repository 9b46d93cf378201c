"""Trials of mistakes in a week's capstone: level 2 samples those that it shows.

Most mistakes of a function change no number of the capstone (its angles never come near
pi, its torques never to a limit), and some stop it with a TypeError of Python alone.
Neither can be hunted. `labkit.hunt.capstone_list` holds the others:

    python scripts/hunt_bug.py 7 --write-seen       for authors; it takes minutes
"""

import contextlib
import re
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import FrameType, ModuleType, SimpleNamespace
from typing import Any, NamedTuple

from labkit.hunt.capstone_list import write
from labkit.hunt.mistakes import HiddenMistake, called_by_capstone
from labkit.lesson.day import Day, days_of
from labkit.lesson.lab_module import load_lab
from robo47.errors import Robo47Error

SECONDS = 60  # of the processor: the longest that an attempt may take


class Attempt(NamedTuple):
    """The visible result of a capstone."""

    line: str  # its row of numbers, or why it stopped
    done: bool  # the attempt came to an end
    words: bool = True  # an exception's text is the kit's, not Python's


def attempt(capstone: ModuleType, fns: Any, name: str) -> Attempt:
    """Do a capstone with some functions; return an error as its line."""
    try:
        return Attempt(str(capstone.row(name, capstone.attempt(fns))), True)
    except Exception as error:
        kind = "" if isinstance(error, Robo47Error) else f"{type(error).__name__}: "
        ours = isinstance(error, Robo47Error)
        return Attempt(f"{name}: it stops. {kind}{error}", False, ours)


def shows(one: HiddenMistake, found: Attempt, right: Attempt) -> bool:
    """Return whether the capstone shows a mistake so that it can be hunted.

    The numbers differ from the right ones, or the message of an error does not name the
    function.
    """
    if found.done:
        return found.line != right.line
    return found.words and not re.search(rf"\b{one.function}\b", found.line)


def trials(
    capstone: ModuleType, labs: Mapping[int, ModuleType], pool: Iterable[HiddenMistake]
) -> Iterator[tuple[HiddenMistake, Attempt, bool]]:
    """Yield each mistake of a pool, its attempt, and whether it can be hunted.

    Args:
        capstone: of the week.
        labs: the kit's, by day.
        pool: mistakes of functions that the capstone calls.
    """
    library = vars(capstone.library())
    own = {n: labs[d] for d, names in capstone.USES.items() if d in labs for n in names}

    def functions() -> SimpleNamespace:
        asked = {n: vars(lab)[n] for n, lab in own.items() if n in vars(lab)}
        return SimpleNamespace(**{**library, **asked})

    right = attempt(capstone, functions(), "")
    for one in pool:
        lab = vars(labs[one.day])
        kept = lab[one.function]
        lab[one.function] = one.code
        with _time_limit():
            found = attempt(capstone, functions(), "")
        lab[one.function] = kept
        yield one, found, shows(one, found, right)


@contextlib.contextmanager
def _time_limit() -> Iterator[None]:
    """Stop an attempt that takes longer than SECONDS, however busy the machine is."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TimeoutError(f"it takes over {SECONDS} s of the processor's time")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def write_all(day: Day, say: Callable[[str], None]) -> str:
    """Try all mistakes that the capstone of a day's week may show, and write the list.

    Args:
        day: the last one of its week.
        say: is told each, as it is tried.

    Returns:
        A sentence's end with the number of those that show.
    """
    from labkit.check.own_functions import capstone_of

    labs = {other.number: load_lab(other.source) for other in days_of(day.week)}
    found: dict[tuple[str, str], bool] = {}
    for one, what, can in trials(capstone_of(day.week), labs, called_by_capstone(day)):
        say(f"{'shows' if can else '  -  '}  {one.function} {one.slug}: {what.line}")
        key = (one.function, one.slug)
        found[key] = can and found.get(key, True)  # made in two ways: both must show
    write(day.week, [key for key, can in found.items() if can])
    return f"{sum(found.values())} of {len(found)} show"

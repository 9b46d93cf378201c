"""Tests of a week's capstone: its words, its functions, one attempt and its film."""

from collections.abc import Iterator
from types import ModuleType
from typing import Any

import numpy as np

from labkit.check.own_functions import capstone_of
from labkit.lesson.day import Day, find_day
from labkit.lesson.lab_module import lab_of
from labkit.lesson.week import Week, manifests
from robo47.attempt import Film, Summary

WORDS = ("NAME", "THING", "GOAL", "HEAD")


def faults_of(day: Day) -> Iterator[str]:
    """Yield what is not as it must be in the capstone of a week, with its last day.

    Raises:
        Robo47Error: the module does not load, or lacks something.
    """
    if day.week.capstone and day.number == max(day.week.days):
        yield from capstone_faults(day.week)


def capstone_faults(week: Week) -> Iterator[str]:
    """Yield what is not as `robo47.attempt` has it in a week's capstone."""
    capstone = capstone_of(week)
    name = capstone.__name__
    for word in WORDS:
        if not isinstance(getattr(capstone, word), str):
            yield f"{name}: {word} is no text"
    named = list(_uses(capstone))
    yield from named
    if named:
        return
    try:
        yield from _attempted(capstone)
    except Exception as error:
        yield f"{name} with the library's functions: {type(error).__name__}: {error}"


def _uses(capstone: ModuleType) -> Iterator[str]:
    """Yield what is wrong with the functions that it says it calls."""
    name = capstone.__name__
    if not isinstance(capstone.USES, dict):
        yield f"{name}: USES is no {{day: (function, ...)}}"
        return
    library = vars(capstone.library())
    for number, names in capstone.USES.items():
        if number not in manifests():
            yield f"{name}: USES has day {number}, which is not there"
            continue
        lab = lab_of(find_day(number))
        for one in names:
            if not hasattr(lab, one):
                yield f"{name}: USES has {one} of day {number}, whose lab has none"
            if one not in library:
                yield f"{name}: library() has no {one}, which USES has"


def _attempted(capstone: ModuleType) -> Iterator[str]:
    """Yield what is wrong with an attempt by the library, a random one, and a film."""
    name = capstone.__name__
    fns = capstone.library()
    for seed in (None, 1):
        result = capstone.attempt(fns, seed)
        if result.failed:
            yield f"{name}: attempt(library(), {seed}) has failed; it must arrive"
        if not isinstance(capstone.row("one", result), str):
            yield f"{name}: row(name, result) is no text, the line of a table"
        if seed is None:
            yield from _summary_faults(
                name, capstone.summary(result), capstone.film(result)
            )


def _summary_faults(name: str, told: Any, film: Any) -> Iterator[str]:
    """Yield what is wrong with what is said of an attempt, and with its film."""
    for found, kind in ((told, Summary), (film, Film)):
        if not isinstance(found, kind):
            what = kind.__name__.lower()
            yield f"{name}: {what}(result) is no robo47.attempt.{kind.__name__}"
            return
    missing = set(film.moments) - {phase for phase, _ in film.phases}
    if missing:
        yield f"{name}: film: moment {min(missing)!r} is the name of no phase"
    if len(film.t) != len(film.qpos) or not np.isfinite(film.qpos).all():
        yield f"{name}: film: qpos must be finite, and as long as t"
    elif film.model().nq > np.shape(film.qpos)[1]:
        yield f"{name}: film: a row of qpos is shorter than the model's"

"""A week's capstone with a student's functions, in the sandbox; as a film."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from labkit.base.text import visible
from labkit.check.lab_run import FirstFailure, behind_wall
from labkit.check.own_functions import OwnCount, counted
from labkit.check.slow import Budget, RunsOn, TimeUsedUp
from labkit.lesson.lab_module import lab_of
from labkit.report.week_facts import DayFacts
from labkit.sandbox.sandbox import Sandbox
from robo47.attempt import Film

if TYPE_CHECKING:
    from labkit.inspector.recording import Recording

NUMBERS = 1_000_000  # numbers in one answer: a camera's picture has 3 a pixel
SECONDS = 240.0  # CPU seconds; the pick with all functions right makes 30,000 calls


class Attempt(NamedTuple):
    """The result of an attempt at the capstone."""

    # the module of the attempt; None for a week without one
    capstone: ModuleType | None
    result: Any  # None where the arm stopped
    stopped: str  # why it did, in a line
    theirs: frozenset[str]  # its functions that are the student's, since they pass
    # The kit's own functions ran in place of these, whose arguments cannot travel.
    stayed: frozenset[str] = frozenset()

    @property
    def counted(self) -> OwnCount:
        """The number of functions that are the student's, as for `make capstone`."""
        uses = self.capstone.USES if self.capstone else {}
        own = {day: self.theirs.intersection(names) for day, names in uses.items()}
        return counted(uses, own)


NO_CAPSTONE = Attempt(None, None, "", frozenset())


def attempt(
    capstone: ModuleType,
    days: Sequence[DayFacts],
    folders: Sequence[Path],
    sandbox: Sandbox,
) -> Attempt:
    """Attempt it with the functions that pass, the library's for the rest.

    Args:
        capstone: the week's, as `robo47.attempt` has it.
        days: the week's.
        folders: where the student's files of each are.
        sandbox: that runs them.
    """
    fns = capstone.library()
    budget = Budget(SECONDS)
    theirs: set[str] = set()
    for facts, place in zip(days, folders, strict=True):
        wanted = set(capstone.USES.get(facts.day.number, ())) & set(facts.own)
        if wanted:
            script = place / facts.day.script
            lab = lab_of(facts.day)
            limits = replace(facts.day.limits, numbers=NUMBERS)
            own = behind_wall(facts.day, script, sandbox, lab, budget, limits)
            for name in wanted:
                setattr(fns, name, own[name])
            theirs |= wanted
    result, stopped = _tried(capstone, fns, budget) if theirs else (None, "")
    stayed = frozenset(budget.stayed)
    return Attempt(capstone, result, stopped, frozenset(theirs), stayed)


def _tried(capstone: ModuleType, fns: Any, budget: Budget) -> tuple[Any, str]:
    """Return what came of an attempt, None with why where the arm stopped."""
    try:
        with np.errstate(all="ignore"), budget.bounded():
            result = capstone.attempt(fns)
        if np.isfinite(capstone.film(result).qpos).all():
            return result, ""
        return None, "the arm flew off"
    except (TimeUsedUp, RunsOn):
        return None, "it took too long"
    # a strange answer may stop the simulation
    except (FirstFailure, Exception) as error:
        return None, visible(error, 300)


def recorded(film: Film) -> "Recording":
    """Return a film, phase by phase, as it was simulated."""
    from labkit.inspector.recording import FRAMES, Recording  # viser is an extra

    recording = Recording(film.model(), back=film.back)
    begins = [begin for _, begin in film.phases]
    for t in np.arange(0.0, film.seconds, 1 / FRAMES):
        row = min(int(np.searchsorted(film.t, t)), len(film.t) - 1)
        recording.pose(film.qpos[row])
        recording.say(film.phases[int(np.searchsorted(begins, t, "right")) - 1][0])
        recording.wait()
    return recording

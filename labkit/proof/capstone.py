"""A week's capstone with a student's functions, in the sandbox; as a film."""

from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from labkit.base.text import visible
from labkit.check.lab_run import FirstFailure, behind_wall
from labkit.check.slow import Budget, EnoughAsked, RunsOn
from labkit.lesson.lab_module import lab_of
from labkit.report.week_facts import DayFacts
from labkit.sandbox.sandbox import Sandbox
from robo47.attempt import Film

if TYPE_CHECKING:
    from labkit.inspector.recording import Recording

SECONDS = 240.0  # of a processor; the pick with all functions right makes 30,000 calls


class Attempt(NamedTuple):
    """What came of it."""

    capstone: ModuleType | None  # as `robo47.attempt` has it; None of a week without
    result: Any  # None where the arm stopped
    stopped: str  # why it did, in a line
    yours: int  # how many of its functions are the student's
    total: int  # of how many


NO_CAPSTONE = Attempt(None, None, "", 0, 0)


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
    yours = 0
    names = {name for some in capstone.USES.values() for name in some}
    for facts, place in zip(days, folders, strict=True):
        wanted = set(capstone.USES.get(facts.day.number, ())) & set(facts.own)
        if wanted:
            script = place / facts.day.script
            lab = lab_of(facts.day)
            own = behind_wall(facts.day, script, sandbox, lab, budget)
            for name in wanted:
                setattr(fns, name, own[name])
            yours += len(wanted)
    if not yours:
        return Attempt(capstone, None, "", 0, len(names))
    try:
        with np.errstate(all="ignore"), budget.bounded():
            result = capstone.attempt(fns)
        if np.isfinite(capstone.film(result).qpos).all():
            return Attempt(capstone, result, "", yours, len(names))
        why = "the arm flew off"
    except (EnoughAsked, RunsOn):
        why = "it took too long"
    except (FirstFailure, Exception) as error:  # what a strange answer leads to
        why = visible(error, 300)
    return Attempt(capstone, None, why, yours, len(names))


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

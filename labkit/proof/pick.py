"""The capstone with a student's functions, in the sandbox; as a film."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from labkit.base.text import visible
from labkit.check.lab_run import Budget, EnoughAsked, FirstFailure, behind_wall
from labkit.lesson.lab_module import lab_of
from labkit.report.week_facts import DayFacts
from labkit.sandbox.sandbox import Sandbox
from robo47 import capstone, scenes
from robo47.capstone.phases import Result

if TYPE_CHECKING:
    from labkit.inspector.recording import Recording

CALLS, SECONDS = 200_000, 240.0  # of a pick; with all functions right it needs 30,000


class Picked(NamedTuple):
    """What came of it."""

    result: Result | None  # None where the arm stopped
    stopped: str  # why it did, in a line
    yours: int  # how many of its functions are the student's
    total: int  # of how many


NO_PICK = Picked(None, "", 0, 0)  # of a week without a capstone


def pick(days: Sequence[DayFacts], folders: Sequence[Path], sandbox: Sandbox) -> Picked:
    """Pick the cube up with the functions that pass, the library's for the rest."""
    fns = capstone.library()
    budget = Budget(CALLS, SECONDS)
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
        return Picked(None, "", 0, len(names))
    try:
        with np.errstate(all="ignore"):
            result = capstone.pick(fns)
        if np.isfinite(result.qpos).all():
            return Picked(result, "", yours, len(names))
        why = "the arm flew off"
    except EnoughAsked:
        why = "it took too long"
    except (FirstFailure, Exception) as error:  # what a strange answer leads to
        why = visible(error, 300)
    return Picked(None, why, yours, len(names))


def film(result: Result) -> "Recording":
    """Return a pick, phase by phase, as `capstone.pick` simulated it."""
    from labkit.inspector.recording import FRAMES, Recording  # viser is an extra

    model = scenes.table_top(capstone.CUBE_XY, capstone.YAW, meshes=True)
    recording = Recording(model, back=1.2)
    begins = [begin for _, begin in result.phases]
    for t in np.arange(0.0, result.seconds, 1 / FRAMES):
        row = min(int(np.searchsorted(result.t, t)), len(result.t) - 1)
        recording.pose(result.qpos[row])
        recording.say(result.phases[int(np.searchsorted(begins, t, "right")) - 1][0])
        recording.wait()
    return recording

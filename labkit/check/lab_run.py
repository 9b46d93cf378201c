"""The day's lab, run with a student's functions: what the lab checks, the check asks.

The kit's own lab runs here; each of the student's functions stands behind the
sandbox's wall and is asked call by call. The first check that fails ends the run.
"""

import contextlib
import inspect
import io
import time
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

import mujoco
import numpy as np

from labkit.base.exchange import Path as Chain
from labkit.base.exchange import Question
from labkit.handin.handin import Item
from labkit.judge.ask import Robot
from labkit.judge.replies_read import stops_with
from labkit.lesson.added_code import old_names
from labkit.lesson.day import Day
from labkit.lesson.lab import Lab, number_of
from labkit.lesson.lab_module import load_lab
from labkit.lesson.metric import Metric
from labkit.sandbox.messages import PANDA, library_of
from labkit.sandbox.sandbox import Sandbox, Session

ROBOTS = [PANDA, Robot("panda")]  # those that labs hand to a function
TRIALS = 15  # random inputs per step: a mistake that shows in a lab shows in these
CALLS = 8_000  # of the student's functions, a second or two; simulations ask more
SECONDS = 60.0  # for all of them; a slow function is no wrong one


class FirstFailure(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """A check of the lab failed, or a function stopped; the text says which."""


class EnoughAsked(Exception):  # noqa: N818
    """As many calls or seconds went by as a check may take."""


class Rehearsal(Lab):
    """The lab's recorder, which writes nothing and stops at the first failure."""

    def __init__(
        self, day: Day, numbers: dict[tuple[str, str], float], file: str, _: str | None
    ) -> None:
        """Take the day, what takes its numbers, and what a `Lab` takes."""
        self.log = False
        self.trial = False
        self.script = Path(file)
        self.day = day
        self.numbers = numbers
        self.title = ""
        self.failed = []
        self.rows = []
        self.predicted = {}

    def step(self, title: str) -> None:
        """Remember the heading."""
        self.title = title

    @contextlib.contextmanager
    def side_quest(self) -> Iterator[None]:
        """Go on where what is optional fails, or is still to do."""
        with contextlib.suppress(FirstFailure):
            yield

    def _judge(self, name: str, wanted: Metric, value: float) -> None:
        if not wanted.passes(value):
            where = f'at "{self.title}", ' if self.title else ""
            raise FirstFailure(
                f"{where}{name} is {number_of(value)}; it must be {wanted.limit}"
            )
        if wanted.check:
            self.numbers[wanted.check, wanted.metric] = value


def check_lab(day: Day, script: Path, sandbox: Sandbox) -> list[Item]:
    """Return what a check says of the lab: nothing where no step of it fails."""
    if not (failed := rehearse(day, script, sandbox)[0]):
        return []
    says = f"All tasks pass, but the lab fails with your functions: {failed}."
    return [Item("lab", "wrong", f"{says}\nSee it: make run DAY={day.number}")]


def rehearse(
    day: Day, script: Path, sandbox: Sandbox, calls: int = CALLS
) -> tuple[str, dict[tuple[str, str], float]]:
    """Run the lab with a file's functions, each behind the sandbox's wall.

    Args:
        day: from its manifest; where its complete lab is not there, nothing is said.
        script: the student's file; all its tasks pass.
        sandbox: where its functions run.
        calls: of those functions, at most.

    Returns:
        The first step that fails, or ""; the numbers that the steps before it gave,
        by check and metric, with `TRIALS` random inputs instead of the lab's own.
    """
    numbers: dict[tuple[str, str], float] = {}
    if not day.source.is_file():
        return "", numbers
    lab = load_lab(day.source)
    vars(lab).update(behind_wall(day, script, sandbox, lab, Budget(calls)))
    counts = [k for k in ("TRIALS", "LIBRARY_TRIALS") if hasattr(lab, k)]
    vars(lab).update(dict.fromkeys(counts, TRIALS))
    vars(lab)["Lab"] = partial(Rehearsal, day, numbers)
    fault = ""
    try:
        with (
            contextlib.redirect_stdout(io.StringIO()),
            contextlib.suppress(EnoughAsked),
            warnings.catch_warnings(action="ignore"),
            np.errstate(all="ignore"),
        ):
            lab.main()
    except FirstFailure as failure:
        fault = str(failure)
    except Exception as error:  # what a wrong number leads to, in the kit's own code
        fault = f"it stops with {type(error).__name__}: {error}"
    return fault, numbers


def behind_wall(
    day: Day, script: Path, sandbox: Sandbox, lab: ModuleType, budget: "Budget"
) -> dict[str, Callable[..., Any]]:
    """Return a file's functions, by name; each call of one is asked in the sandbox.

    Args:
        day, script, sandbox: as those of `rehearse`.
        lab: the complete one, whose functions have the same arguments.
        budget: of calls and seconds.
    """
    added = old_names(day, script.read_text("utf-8", "replace"))
    library = library_of(day)
    session = sandbox.session(script, ROBOTS, library, added, day.limits, brief=True)
    return {
        name: _asked(session, task.id, getattr(lab, name), budget)
        for task in day.tasks
        for name in task.functions
    }


class Budget:
    """Calls and seconds that are left."""

    def __init__(self, calls: int = CALLS, seconds: float = SECONDS) -> None:
        """Start the clock."""
        self.calls = calls
        self.deadline = time.monotonic() + seconds

    def spend(self) -> None:
        """Take one call.

        Raises:
            EnoughAsked: none is left.
        """
        self.calls -= 1
        if self.calls < 0 or time.monotonic() > self.deadline:
            raise EnoughAsked


def _asked(
    session: Session, task: str, right: Callable[..., Any], budget: Budget
) -> Callable[..., Any]:
    """Return a function of the lab whose answers come from the sandbox."""
    signature = inspect.signature(right)

    def ask(*args: Any, **named: Any) -> Any:
        budget.spend()
        bound = signature.bind(*args, **named)
        bound.apply_defaults()
        question = Question(task, right.__name__, tuple(map(_sent, bound.args)))
        (reply,) = session.ask([question])
        if reply.kind:
            says = stops_with(reply).rstrip(".").removeprefix("It ")
            raise FirstFailure(f"{right.__name__} {says}")
        return reply.value

    return ask


def _sent(arg: Any) -> Any:
    """Return an argument as questions have it.

    Raises:
        EnoughAsked: a robot that the session was not given.
    """
    if isinstance(arg, mujoco.MjModel):
        for robot in ROBOTS:
            if robot.model.nq == arg.nq:
                return robot
        raise EnoughAsked
    if isinstance(arg, list | tuple) and arg and all(map(_of_a_chain, arg)):
        return Chain(tuple(arg))
    return arg


def _of_a_chain(pair: Any) -> bool:
    """Return whether it is a body and its joint or None, as in a `Chain`."""
    return isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], str)

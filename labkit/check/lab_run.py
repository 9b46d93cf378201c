"""The day's lab, run with a student's functions: what the lab checks, the check asks.

The kit's own lab runs here; each of the student's functions stands behind the
sandbox's wall and is asked call by call. The first check that fails ends the run.
A world that answers questions itself stays here, and the function behind the wall asks
back. Where a lab hands over what cannot travel there, the kit's own function takes that
call: all tasks pass, so it is their equal.
"""

import contextlib
import inspect
import io
import warnings
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, partial
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import mujoco
import numpy as np

from labkit.base.deadline import Deadline
from labkit.base.exchange import Path as Chain
from labkit.base.exchange import Question
from labkit.check.slow import (
    Budget,
    Functions,
    RunsOn,
    TimeUsedUp,
    kits_functions,
    not_to_its_end,
    runs_on,
    too_slow,
)
from labkit.handin.handin import Item
from labkit.judge.ask import Robot
from labkit.judge.mistake import Verdict
from labkit.judge.replies_read import no_answer, stops_with
from labkit.judge.row import rows_of
from labkit.lesson.added_code import old_names
from labkit.lesson.day import Day, Limits, Task
from labkit.lesson.hidden_numbers import Output
from labkit.lesson.lab import Lab, number_of
from labkit.lesson.lab_module import load_lab
from labkit.lesson.metric import Metric
from labkit.sandbox.messages import PANDA, StaysError, library_of
from labkit.sandbox.process import ENDLESS
from labkit.sandbox.sandbox import (
    CALL_SECONDS,
    TOO_LONG,
    Sandbox,
    Session,
    deadline_of,
)

ROBOTS = (PANDA, Robot("panda"))  # those that labs hand to a function
# A model that differs in one of these fields is another robot.
MADE_OF = ("body_pos", "body_quat", "body_mass", "jnt_axis", "jnt_pos")
TRIALS = 15  # random inputs per step: a mistake that shows in a lab shows in these


class FirstFailure(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """A check of the lab failed, or a function stopped; the text says which."""


@dataclass
class _Run:
    """The record of a lab's run."""

    day: Day
    numbers: dict[tuple[str, str], float] = field(default_factory=dict)
    title: str = ""  # the title of the present step


class Rehearsal(Lab):
    """The lab's recorder, which writes nothing and stops at the first failure."""

    def __init__(self, run: "_Run", file: str, _: str | None) -> None:
        """Take what is kept of the run, and what a `Lab` takes."""
        self.log = False
        self.trial = False
        self.script = Path(file)
        self.day = run.day
        self._run = run
        self.failed = []
        self.rows = []
        self.predicted = {}
        self.output = Output(())

    def step(self, title: str) -> None:
        """Remember the heading."""
        self._run.title = title

    @contextlib.contextmanager
    def side_quest(self) -> Iterator[None]:
        """Go on where what is optional fails, or is still to do."""
        with contextlib.suppress(FirstFailure):
            yield

    def _judge(self, name: str, wanted: Metric, value: float) -> None:
        if not wanted.passes(value):
            where = f'at "{self._run.title}", ' if self._run.title else ""
            raise FirstFailure(
                f"{where}{name} is {number_of(value)}; it must be {wanted.limit}"
            )
        if wanted.check:
            self._run.numbers[wanted.check, wanted.metric] = value


class LabRun(NamedTuple):
    """The result of a lab's run with a file's functions."""

    fault: str  # the first step that fails, "" where none did
    # The results of the steps before it, by check and metric, with `TRIALS` random
    # inputs instead of the lab's own.
    numbers: dict[tuple[str, str], float]
    unfinished: str = ""  # a sentence if the run was stopped, else ""


def check_lab(
    day: Day,
    script: Path,
    sandbox: Sandbox,
    deadline: Deadline | None = None,
    stop: Callable[[], bool] | None = None,
) -> list[Item]:
    """Return what a check says of the lab: nothing where it passes to its end.

    The arguments are those of `rehearse`.
    """
    fault, _, unfinished = rehearse(day, script, sandbox, deadline, stop)
    see = f"\nSee it: make run DAY={day.number}"
    if fault:
        says = f"All tasks pass, but the lab fails with your functions: {fault}."
        return [Item("lab", "wrong", f"{says}{see}")]
    return [Item("lab", "unfinished", f"{unfinished}{see}")] if unfinished else []


def rehearse(
    day: Day,
    script: Path,
    sandbox: Sandbox,
    deadline: Deadline | None = None,
    stop: Callable[[], bool] | None = None,
) -> LabRun:
    """Run the lab with a file's functions, each behind the sandbox's wall.

    Args:
        day: from its manifest; where its complete lab is not there, nothing is said.
        script: the student's file; all its tasks pass.
        sandbox: where its functions run.
        deadline: of the submission, whose tasks were asked; None is one of its own.
        stop: asked twice a second, from another thread, whether to end the run.

    Raises:
        StoppedEarly: `stop` ended it.
    """
    if not day.source.is_file():
        return LabRun("", {})
    lab = load_lab(day.source)
    run = _Run(day)
    whole = deadline or deadline_of(day)
    budget = Budget(day.lab_seconds, kits_functions(day), whole=whole)
    vars(lab).update(behind_wall(day, script, sandbox, lab, budget))
    counts = [k for k in ("TRIALS", "LIBRARY_TRIALS") if hasattr(lab, k)]
    vars(lab).update(dict.fromkeys(counts, TRIALS))
    vars(lab)["Lab"] = partial(Rehearsal, run)
    fault = unfinished = ""
    try:
        with (
            contextlib.redirect_stdout(io.StringIO()),
            warnings.catch_warnings(action="ignore"),
            np.errstate(all="ignore"),
            budget.bounded(stop),
        ):
            try:
                lab.main()
            except TimeUsedUp:
                unfinished = not_to_its_end(run.title, budget)
    except RunsOn:
        fault = runs_on(run.title, budget)
    except FirstFailure as failure:
        fault = str(failure)
    except Exception as error:  # a wrong number can cause any error in the kit's code
        fault = f"it stops with an error, `{type(error).__name__}: {error}`"
    if unfinished and whole.over:
        fault, unfinished = TOO_LONG, ""
    return LabRun(fault, run.numbers, unfinished)


def behind_wall(
    day: Day,
    script: Path,
    sandbox: Sandbox,
    lab: ModuleType,
    budget: Budget,
    limits: Limits | None = None,
) -> dict[str, Callable[..., Any]]:
    """Return a file's functions, by name; each call of one is asked in the sandbox.

    Args:
        day, script, sandbox: as those of `rehearse`.
        lab: the complete one, whose functions have the same arguments.
        budget: of seconds; it keeps whose calls could not travel.
        limits: what the file may take; None is what its tasks may.
    """
    limits = limits or day.limits
    added = old_names(day, script.read_text("utf-8", "replace"))
    library = library_of(day)
    robots = (*ROBOTS, *_own_robots(day))
    session = sandbox.session(
        script, robots, library, added, limits, brief=True, deadline=budget.whole
    )
    budget.watch(session)
    kits = cache(kits_functions(day))
    return {
        name: _query(session, day, robots, task, getattr(lab, name), budget, kits)
        for task in day.tasks
        for name in task.functions
    }


def _own_robots(day: Day) -> list[Robot]:
    """Return the robots of a day's folder: those that its rows ask about by a path."""
    args = (arg for row in rows_of(day).values() for arg in chain(*row.ask.main))
    found = dict.fromkeys(arg for arg in args if isinstance(arg, Robot))
    return [robot for robot in found if isinstance(robot.entry, Path)]


def _query(
    session: Session,
    day: Day,
    robots: Iterable[Robot],
    task: Task,
    right: Callable[..., Any],
    budget: Budget,
    kits: Callable[[], Functions],
) -> Callable[..., Any]:
    """Return a function of the lab whose answers come from the sandbox."""
    name = right.__name__
    signature = inspect.signature(right)
    seconds = max(CALL_SECONDS, task.seconds / 3.0)

    def ask(*args: Any, **named: Any) -> Any:
        bound = signature.bind(*args, **named)
        bound.apply_defaults()
        sent = tuple(_sent(arg, robots) for arg in bound.args)
        budget.spend(name, bound.args)
        try:
            (reply,) = session.ask([Question(task.id, name, sent)], seconds)
        except StaysError:
            budget.stayed.add(name)
            return kits()[name](*bound.args)
        if reply.error == ENDLESS:
            reply = replace(reply, given=seconds)
            early: Verdict | None = too_slow(day, name, bound.args, reply)
        else:
            early = no_answer(reply, name, task.id)
        if early:
            raise FirstFailure(early.message.rstrip("."))
        if reply.kind:
            says = stops_with(reply).rstrip(".").removeprefix("Your function ")
            raise FirstFailure(f"{name} {says}")
        return reply.value

    return ask


def _sent(arg: Any, robots: Iterable[Robot]) -> Any:
    """Return an argument as questions have it.

    Raises:
        TimeUsedUp: a robot that the session was not given.
    """
    if isinstance(arg, mujoco.MjModel):
        for robot in robots:
            if _same(robot.model, arg):
                return robot
        raise TimeUsedUp
    if isinstance(arg, list | tuple) and arg and all(map(_of_a_chain, arg)):
        return Chain(tuple(arg))
    return arg


def _same(one: mujoco.MjModel, other: mujoco.MjModel) -> bool:
    """Return whether two models are of one robot; their motors may differ."""
    return all(
        np.array_equal(getattr(one, name), getattr(other, name)) for name in MADE_OF
    )


def _of_a_chain(pair: Any) -> bool:
    """Return whether it is a body and its joint or None, as in a `Chain`."""
    return isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], str)

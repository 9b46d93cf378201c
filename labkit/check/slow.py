"""How long a student's functions may take, beside what the kit's own take here.

A lab's run has seconds, `[limits] lab_seconds` of its day.toml, and no count of calls;
what it waits for a processor does not count. Where they are up, the kit's own functions
are timed here, with the same arguments: if the student's are about as fast, the machine
is slow or the lab is long, and it goes on, up to `MORE` times as long. What was not run
to its end is said.
"""

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from labkit.base import processes
from labkit.base.exchange import Question, Reply
from labkit.base.text import count
from labkit.judge.answers import own
from labkit.judge.ask import as_plain
from labkit.judge.mistake import Verdict
from labkit.lesson.day import MOST_LAB, Day
from labkit.lesson.lab_module import load_lab

MORE = 3.0  # times as long, where the student's functions are not what is slow
FAST = 3.0  # times what the kit's own take: about as fast as those
LITTLE = 0.1  # of all seconds: too little to slow a lab down
EMPTY = 50  # questions that ask for nothing, to learn what asking takes
NOTHING = "no function has this name"
# How many times what the kit's own takes, or the longest call that came back, is long
# enough for any right way: who takes longer runs on and on.
ENDLESS = 100.0

Functions = Mapping[str, Callable[..., Any]]


class EnoughAsked(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """As many seconds went by as a lab's run may take."""


class Asked(Protocol):
    """A process that answers: a `Session`."""

    def used(self) -> tuple[float, float]:
        """Return for how many seconds it had a processor, and waited for one."""

    def ask(self, questions: Sequence[Question], /) -> object:
        """Ask it."""


class Budget:
    """Seconds that are left, and what they went for."""

    def __init__(
        self,
        seconds: float,
        kits: Callable[[], Functions] = dict,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Start the clock.

        Args:
            seconds: for the lab and the student's functions together; what they wait
                for a processor does not count.
            kits: makes the kit's own functions, to time them.
            clock: in seconds.
        """
        self.seconds = seconds
        self._kits = kits
        self._clock = clock
        self._began = clock()
        self._asked: list[Asked] = []
        self._before = processes.waited()
        self._waited = 0.0  # by all of us, when last looked
        self.calls = Counter[str]()
        self._last: dict[str, tuple[Any, ...]] = {}  # arguments
        self._kits_own: dict[str, float] | None = None  # seconds a call

    def watch(self, asked: Asked) -> None:
        """Count what another process takes, too."""
        self._asked.append(asked)

    def spend(self, name: str, args: tuple[Any, ...]) -> None:
        """Take a call.

        Raises:
            EnoughAsked: no time is left.
        """
        if self._left() < 0.0:
            theirs = sum(one.used()[1] for one in self._asked)
            self._waited = processes.waited() - self._before + theirs
            if self._left() < 0.0 and not self._goes_on():
                raise EnoughAsked
        self.calls[name] += 1
        self._last[name] = args

    def told(self) -> str:
        """Return what the time went for, as a sentence's end."""
        calls = count(self.calls.total(), "call")
        kits = f"the kit's own take {self._kits_took():.2g} s for as many here"
        says = f"{self.seconds:.3g} s went by, with {calls} of the tasks' functions"
        return f"{says}; {kits}"

    def _left(self) -> float:
        return self.seconds - (self._clock() - self._began - self._waited)

    def _goes_on(self) -> bool:
        """Return whether the functions are fast and it goes on, which it may once."""
        if self._kits_own is not None:
            return False
        asking = self._asking() * self.calls.total()
        theirs = sum(one.used()[0] for one in self._asked) - asking
        if theirs > FAST * self._kits_took() + LITTLE * self.seconds:
            return False
        self.seconds = max(self.seconds, min(MORE * self.seconds, MOST_LAB))
        return True

    def _asking(self) -> float:
        """Return how long a process works at a question that asks for nothing."""
        nothing = [Question("", NOTHING, ())] * EMPTY
        for one in self._asked[:1]:
            before = one.used()[0]
            one.ask(nothing)
            return (one.used()[0] - before) / EMPTY
        return 0.0

    def _kits_took(self) -> float:
        return sum(self._reference()[name] * n for name, n in self.calls.items())

    def _reference(self) -> dict[str, float]:
        """Return how many seconds a call of the kit's own takes here."""
        if self._kits_own is None:
            functions = self._kits()
            self._kits_own = {
                name: seconds_of(functions.get(name), args)
                for name, args in self._last.items()
            }
        return self._kits_own


def seconds_of(function: Callable[..., Any] | None, args: Sequence[Any]) -> float:
    """Return how many seconds a call takes here, 0 where it stops."""
    times = []
    for _ in range(2 if function else 0):  # the first time it may load something
        mine = [own(as_plain(arg)) for arg in args]
        started = time.perf_counter()
        try:
            function(*mine)  # type: ignore[misc]
        except Exception:  # of arguments that a wrong number led to
            return 0.0
        times.append(time.perf_counter() - started)
    return min(times, default=0.0)


def kits_functions(day: Day) -> Callable[[], Functions]:
    """Return what makes the functions of a day's complete lab, as they are."""
    names = [name for task in day.tasks for name in task.functions]

    def made() -> Functions:
        lab = load_lab(day.source)
        return {name: getattr(lab, name) for name in names if hasattr(lab, name)}

    return made


def not_to_its_end(title: str, budget: Budget) -> str:
    """Return that a lab was not run to its end: the same words on every page."""
    where = f' in "{title}"' if title else ""
    return (
        f"The lab was not run to its end here: {budget.told()}. It stopped{where}; "
        "what comes after that was not looked at."
    )


def too_slow(day: Day, function: str, args: Sequence[Any], reply: Reply) -> Verdict:
    """Return the verdict on a call that was stopped: slow, or a loop without an end.

    Args:
        day: whose complete lab is timed with the same arguments.
        function: that was called; args: with what.
        reply: with the time that it was given.
    """
    kits = 0.0
    if day.source.is_file():
        kits = seconds_of(kits_functions(day)().get(function), args)
    given = f"{reply.given:.3g} s"
    beside = f"yours was stopped after {given}"
    if reply.came:
        beside = f"yours was stopped after {count(reply.came, 'call')} and {given}"
    if kits:
        beside = f"the kit's own takes {_briefly(kits)} a call here; {beside}"
    if max(kits, reply.longest) * ENDLESS > reply.given:
        return Verdict("wrong", "too-slow", f"{function} is too slow: {beside}.")
    says = f"{function} did not return: {reply.error} ({beside})."
    return Verdict("wrong", "stopped", says)


def _briefly(seconds: float) -> str:
    return f"{seconds:.2g} s" if seconds >= 0.1 else "under 0.1 s"

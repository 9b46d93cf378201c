"""Time limits of a student's functions, compared with the time of the kit's own.

A lab's run has seconds, `[limits] lab_seconds` of its day.toml, and no count of calls;
what it waits for a processor does not count. Where they are up, the kit's own functions
are timed here, with the same arguments: if the student's are about as fast, the machine
is slow or the lab is long, and it goes on, up to `MORE` times as long. What was not run
to its end is said. Where the kit's own part of it takes longer than all of a lab may,
with what a function returned, that function is why.
"""

import contextlib
import ctypes
import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from labkit.base.deadline import Deadline
from labkit.base.exchange import Question, Reply
from labkit.base.text import count
from labkit.judge.answers import own
from labkit.judge.ask import as_plain
from labkit.judge.mistake import Verdict
from labkit.lesson.day import MOST_LAB, Day
from labkit.lesson.lab_module import load_lab

MORE = 3.0  # times as long, where the student's functions are not what is slow
FAST = 3.0  # times what the kit's own take: about as fast as those
LITTLE = 0.1  # a smaller fraction of the budget cannot slow a lab down
ONE_CALL = 20.0  # seconds that a call of a task may take, at the most
POLL = 0.5  # seconds
EMPTY = 50  # questions that ask for nothing, to learn what asking takes
NOTHING = "no function has this name"
# How many times what the kit's own takes, or the longest call that came back, is long
# enough for any right way: who takes longer runs on and on.
ENDLESS = 100.0

Functions = Mapping[str, Callable[..., Any]]


class TimeUsedUp(Exception):  # noqa: N818 (it ends a run; nothing went wrong here)
    """As many seconds went by as a lab's run may take."""


class RunsOn(BaseException):
    """The kit's own part of a lab runs on and on; no lab catches this."""


class StoppedEarly(BaseException):
    """The student has other work for the checker; no lab catches this."""


class Budget(Deadline):
    """Seconds that are left of a lab's run, and what they went for."""

    def __init__(
        self,
        seconds: float,
        kits: Callable[[], Functions] = dict,
        clock: Callable[[], float] = time.monotonic,
        whole: Deadline | None = None,
    ) -> None:
        """Start the clock.

        Args:
            seconds: for the lab and the student's functions together; what they wait
                for a processor does not count.
            kits: makes the kit's own functions, to time them.
            clock: in seconds.
            whole: what the submission has left, in which it must be.
        """
        self.whole = whole or Deadline(math.inf)
        super().__init__(self.whole.within(seconds), clock)
        self._kits = kits
        self.stretch = ONE_CALL + seconds
        self._since = 0.0  # the time of the last call
        self.calls = Counter[str]()
        # Functions whose calls cannot travel; the kit's own ran.
        self.stayed = set[str]()
        self._last: dict[str, tuple[Any, ...]] = {}  # arguments, the latest call last
        self._kits_own: dict[str, float] | None = None  # seconds a call

    def spend(self, name: str, args: tuple[Any, ...]) -> None:
        """Take a call.

        Raises:
            TimeUsedUp: no time is left.
        """
        if self.over and not self._goes_on():
            raise TimeUsedUp
        self._since = self.used
        self.calls[name] += 1
        self._last.pop(name, None)
        self._last[name] = args

    @property
    def latest(self) -> str:
        """The function that was called last."""
        return next(reversed(self._last), "none")

    @contextlib.contextmanager
    def bounded(self, stop: Callable[[], bool] | None = None) -> Iterator[None]:
        """Raise RunsOn here as soon as the kit's own code has run on for too long.

        It may be in a simulation of as many seconds as a function returned. As soon as
        `stop` returns true, raise StoppedEarly.
        """
        here = ctypes.c_ulong(threading.get_ident())
        raise_in = ctypes.pythonapi.PyThreadState_SetAsyncExc
        done = threading.Event()

        def watch() -> None:
            while not done.wait(POLL):
                self._look()
                if self.used - self._since > self.stretch:
                    raise_in(here, ctypes.py_object(RunsOn))
                elif stop and stop():
                    raise_in(here, ctypes.py_object(StoppedEarly))
                    break

        watcher = threading.Thread(target=watch, daemon=True)
        watcher.start()
        try:
            yield
        finally:
            done.set()
            watcher.join()
            raise_in(here, None)  # a late exception is withdrawn

    def time_used(self) -> str:
        """Return what the time went for, as a sentence's end."""
        calls = count(self.calls.total(), "call")
        kits = f"the kit's own take {self._kits_took():.2g} s for as many calls"
        says = f"{self.seconds:.3g} s went by, with {calls} of your functions"
        return f"{says}; {kits}"

    def _goes_on(self) -> bool:
        """Return whether the functions are fast and it goes on, which it may once."""
        if self._kits_own is not None:
            return False
        asking = self._asking() * self.calls.total()
        theirs = sum(one.used()[0] for one in self._working) - asking
        if theirs > FAST * self._kits_took() + LITTLE * self.seconds:
            return False
        most = min(MORE * self.seconds, MOST_LAB)
        most = min(most, self.used + self.whole.within(most))
        self.seconds = max(self.seconds, most)
        return True

    def _asking(self) -> float:
        """Return how long a process works at a question that asks for nothing."""
        nothing = [Question("", NOTHING, ())] * EMPTY
        for one in self._working[:1]:
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
        except Exception:  # a wrong number can lead to arguments that no function takes
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
        f"The lab was not run to its end: {budget.time_used()}. It was stopped{where}, "
        "and the steps after that were not tested."
    )


def runs_on(title: str, budget: Budget) -> str:
    """Return that the kit's own part of a lab was stopped, as a sentence's middle."""
    where = f'at "{title}", ' if title else ""
    return (
        f"{where}the lab does not end with the results of your functions: it was "
        f"stopped {budget.stretch:.0f} s after it called {budget.latest}"
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
        beside = f"the kit's own takes {_briefly(kits)} per call; {beside}"
    if max(kits, reply.longest) * ENDLESS > reply.given:
        return Verdict("wrong", "too-slow", f"{function} is too slow: {beside}.")
    says = f"{function} did not return: {reply.error} ({beside})."
    return Verdict("wrong", "stopped", says)


def _briefly(seconds: float) -> str:
    return f"{seconds:.2g} s" if seconds >= 0.1 else "under 0.1 s"

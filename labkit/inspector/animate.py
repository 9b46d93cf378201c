"""Work that takes time: a loop in real time, and jobs; both end with their tab."""

import asyncio
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Step = Callable[[float], bool | None]
Ended = Callable[[Exception | None], None]  # is given what stopped it
LATE = 0.25  # seconds; a loop that is further behind lets them go


@dataclass
class Animation:
    """Calls a step at a steady rate on the server's event loop."""

    step: Step  # is given the seconds since the start; returning False ends the loop
    # Calls a second. 30 is enough for the eye; let a step do several `mj_step`.
    hz: float
    changed: Ended  # is called when it starts, and when it stops
    # Is called before each step, on another thread: it may wait.
    work: Callable[[float], Any] | None = None
    task: asyncio.Task[None] | None = None
    slow: float = 1.0  # how many times slower than real time it runs
    lasts: float = math.inf  # seconds; after them it ends by itself
    due: bool = False  # whether its work has still to give a first answer

    @property
    def running(self) -> bool:
        """Whether it runs."""
        return self.task is not None

    def start(self, lasts: float = math.inf) -> None:
        """Run from t = 0, unless it runs already; call it from a callback."""
        self.lasts = lasts
        if self.task is None:
            self.due = self.work is not None
            self.task = asyncio.get_running_loop().create_task(self._run())
            self.changed(None)

    def stop(self) -> None:
        """Stop, unless it stands."""
        if self.task is not None:
            self.task.cancel()
            self.task = None
            self.due = False
            self.changed(None)

    def toggle(self) -> None:
        """Start or stop."""
        (self.stop if self.running else self.start)()

    async def _run(self) -> None:
        start = time.perf_counter()
        calls = 0
        stopped = None
        began = start
        period = 1.0 / self.hz
        try:
            while True:
                if self.work is not None:
                    await asyncio.to_thread(self.work, calls * period)
                self.due = False
                seconds = calls * period
                if self.step(seconds) is False or seconds > self.lasts:
                    break
                calls += 1
                ahead = start + calls * period - time.perf_counter()
                if ahead < -LATE:  # the machine is too slow: slow motion, no jump
                    start -= ahead
                self.slow = (time.perf_counter() - began) / (calls * period)
                await asyncio.sleep(max(ahead, 0.001))
        except Exception as error:
            stopped = error
        self.task = None
        self.due = False
        self.changed(stopped)


@dataclass
class Jobs:
    """Calls on another thread, one after the other; of those that wait the newest."""

    ended: Ended = lambda error: None  # is called after each
    next: tuple[Callable[[], Any], Callable[[Any], None]] | None = None
    task: asyncio.Task[None] | None = None
    due: bool = False  # whether the first of those that are wanted is at work

    def want(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do this next; call it from a callback.

        The work may wait; `done` is given what it returned, on the event loop.
        """
        self.next = work, done
        if self.task is None:
            self.due = True
            self.task = asyncio.get_running_loop().create_task(self._run())

    def stop(self) -> None:
        """Forget what waits, and what comes of the one at work."""
        if self.task is not None:
            self.task.cancel()

    async def _run(self) -> None:
        while self.next is not None:
            work, done = self.next
            self.next = None
            stopped = None
            try:
                done(await asyncio.to_thread(work))
            except Exception as error:
                stopped = error
            self.due = False  # only the first failure of a stream is told
            self.ended(stopped)
        self.task = None

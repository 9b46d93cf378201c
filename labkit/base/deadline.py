"""The remaining seconds of a submission: one clock for all processes that work for it.

What this process, or one that it asks, waits for a processor does not count.
"""

import time
from collections.abc import Callable
from typing import Any

from labkit.base import processes


class Deadline:
    """Seconds from now on."""

    def __init__(
        self, seconds: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Start the clock.

        Args:
            seconds: that there are.
            clock: in seconds.
        """
        self.seconds = seconds
        self._clock = clock
        self._began = clock()
        self._own = processes.waited()
        self._waited = 0.0  # the waiting time of all processes at the last look
        self._working: list[Any] = []  # the objects that have `used`
        # The waiting time of each process: first, last.
        self._waits: list[tuple[float, float]] = []

    def watch(self, working: Any) -> None:
        """Count what another process waits, too: a `Process`, a `Session`."""
        if all(one is not working for one in self._working):
            self._working.append(working)
            self._waits.append((working.used()[1], 0.0))

    @property
    def used(self) -> float:
        """Seconds that went by; a little less, if some waited since it last looked."""
        return self._clock() - self._began - self._waited

    def within(self, seconds: float) -> float:
        """Return so many seconds, or what is left where that is less."""
        if self.seconds - self.used < seconds:
            self._look()
        return min(seconds, self.seconds - self.used)

    @property
    def over(self) -> bool:
        """The time is used up."""
        return self.within(0.0) < 0.0

    def _look(self) -> None:
        """See how long we waited; of one that is gone, what was seen last."""
        for i, (one, (first, last)) in enumerate(
            zip(self._working, self._waits, strict=True)
        ):
            self._waits[i] = first, max(last, one.used()[1] - first)
        theirs = sum(since for _, since in self._waits)
        self._waited = max(self._waited, processes.waited() - self._own + theirs)

"""A loop in real time that a tab starts and stops, and that ends with its tab."""

import asyncio
import time
from collections.abc import Callable

Step = Callable[[float], bool | None]
LATE = 0.25  # seconds; a loop that is further behind lets them go


class Animation:
    """Calls a step at a steady rate on the server's event loop."""

    def __init__(self, step: Step, hz: float, changed: Callable[[], None]) -> None:
        """Prepare; nothing runs yet.

        Args:
            step: is given the seconds since the start; returning False ends the loop.
            hz: calls a second. 30 is enough for the eye; let a step do several
                `mj_step` of its own.
            changed: called when it starts and when it stops.
        """
        self.step, self.period, self.changed = step, 1.0 / hz, changed
        self.task: asyncio.Task[None] | None = None
        self.error: Exception | None = None

    @property
    def running(self) -> bool:
        """Whether it runs."""
        return self.task is not None

    def start(self) -> None:
        """Run from t = 0, unless it runs already; call it from a callback."""
        if self.task is None:
            self.error = None
            self.task = asyncio.get_running_loop().create_task(self._run())
            self.changed()

    def stop(self) -> None:
        """Stop, unless it stands."""
        if self.task is not None:
            self.task.cancel()
            self.task = None
            self.changed()

    async def _run(self) -> None:
        start, calls = time.perf_counter(), 0
        try:
            while self.step(calls * self.period) is not False:
                calls += 1
                ahead = start + calls * self.period - time.perf_counter()
                if ahead < -LATE:  # the machine is too slow: slow motion, no jump
                    start -= ahead
                await asyncio.sleep(max(ahead, 0.001))
        except Exception as error:
            self.error = error
        self.task = None
        self.changed()

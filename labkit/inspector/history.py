"""The configuration that is wanted, and those before it."""

import time

from robo47.checks import Array

SECONDS, STEPS = 0.7, 100  # moves closer together than that are one: a drag


class History:
    """Where the arm is to be, and the way back."""

    def __init__(self, q: Array) -> None:
        """Start at a configuration, (nq,)."""
        self.q, self.past, self.moved = q.copy(), [q.copy()], 0.0

    def go(self, q: Array) -> None:
        """Want another configuration, (nq,)."""
        before, self.q = self.q, q.copy()
        now = time.monotonic()
        if now - self.moved > SECONDS:
            self.past = [*self.past[-STEPS:], before]
        self.moved = now

    def back(self) -> None:
        """Want what was wanted before the last move."""
        if self.past:
            self.q, self.moved = self.past.pop(), 0.0

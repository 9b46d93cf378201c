"""Mistakes in task 7.4 `trapezoid(t, L, v, a)`: position, speed, acceleration."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from labkit.judge.mistake import Mistake, each
from robo47.checks import Array


def _top(L: float, v: float, a: float) -> float:
    return min(v, np.sqrt(L * a))


@dataclass(frozen=True)
class Ramps:
    """The profile piece by piece; each attribute is one of its formulas."""

    top: Callable[[float, float, float], float] = _top
    duration: Callable[[float, float, float], float] = lambda L, top, ramp: (
        L / top + ramp
    )
    rising: Callable[[float, float], float] = lambda t, a: a * t**2 / 2
    cruising: Callable[[float, float, float], float] = lambda t, top, ramp: (
        top * (t - ramp / 2)
    )
    falling: Callable[[float, float, float], float] = lambda left, L, a: (
        L - a * left**2 / 2
    )
    slows: float = -1.0  # sign of the acceleration while it slows down
    waits: bool = True  # before the start
    stops: bool = True  # at the end

    def one(self, t: float, L: float, v: float, a: float) -> Array:
        """Return position, speed and acceleration at one time."""
        top = self.top(L, v, a)
        ramp = top / a
        T = self.duration(L, top, ramp)
        if t <= 0 and self.waits:
            return np.zeros(3)
        if t < ramp:
            return np.array([self.rising(t, a), a * t, a])
        if t < T - ramp:
            return np.array([self.cruising(t, top, ramp), top, 0.0])
        left = T - t
        if left <= 0 and self.stops:
            return np.array([self.falling(0.0, L, a), 0.0, 0.0])
        return np.array([self.falling(left, L, a), a * left, self.slows * a])

    def __call__(self, *columns: Array) -> Array:
        """Return all answers, (n, 3)."""
        return each(self.one)(*columns)


TRAPEZOID = [
    Mistake(
        "no-triangle",
        "the top speed is always v; a short way ends before v is reached, so it "
        "overshoots",
        Ramps(top=lambda L, v, a: v),
        "the trapezoid without its triangle",
    ),
    Mistake(
        "always-a-triangle",
        "it never cruises: the top speed is sqrt(L a) even where that is over v",
        Ramps(top=lambda L, v, a: np.sqrt(L * a)),
        "the triangle",
    ),
    Mistake(
        "triangle-too-high",
        "half of the triangle is for braking, so its height is not sqrt(2 L a)",
        Ramps(top=lambda L, v, a: min(v, np.sqrt(2 * L * a))),
        "the triangle with sqrt(2 L a)",
    ),
    Mistake(
        "triangle-too-low",
        "the triangle's height is not sqrt(L a / 2): its area has to be L",
        Ramps(top=lambda L, v, a: min(v, np.sqrt(L * a / 2))),
        "the triangle with sqrt(L a / 2)",
    ),
    Mistake(
        "triangle-not-a-root",
        "the triangle's height is the root of L a; L a itself is the square of a speed",
        Ramps(top=lambda L, v, a: min(v, L * a)),
        "the triangle with L a",
    ),
    Mistake(
        "triangle-too-late",
        "it becomes a triangle only below L = v^2 / (2 a), which is one ramp's way; "
        "there are two ramps",
        Ramps(top=lambda L, v, a: np.sqrt(L * a) if v**2 / (2 * a) > L else v),
        "the triangle below v^2 / (2 a)",
    ),
    Mistake(
        "ramps-take-no-time",
        "the duration is L / v, as if it were at v from the first moment; the ramps "
        "cost one ramp more",
        Ramps(duration=lambda L, top, ramp: L / top),
        "the profile with T = L / v",
    ),
    Mistake(
        "both-ramps-added",
        "the duration is one ramp's time, v / a, too long: compared with full speed, "
        "each ramp costs only half of its own time",
        Ramps(duration=lambda L, top, ramp: L / top + 2 * ramp),
        "the profile with T = L / v + 2 v / a",
    ),
    Mistake(
        "braking-accelerates",
        "while it slows down the acceleration is negative",
        Ramps(slows=1.0),
        "the profile with +a at the end",
    ),
    Mistake(
        "braking-overshoots",
        "the last piece comes from beyond the end: what is left has to be taken off L",
        Ramps(falling=lambda left, L, a: L + a * left**2 / 2),
        "the profile with a plus in the last piece",
    ),
    Mistake(
        "half-forgotten",
        "the way of a ramp is a t^2 / 2, not a t^2",
        Ramps(
            rising=lambda t, a: a * t**2,
            falling=lambda left, L, a: L - a * left**2,
        ),
        "the profile with a t^2",
    ),
    Mistake(
        "half-forgotten",
        "in the first piece, the way of a ramp is a t^2 / 2, not a t^2",
        Ramps(rising=lambda t, a: a * t**2),
        "the profile with a t^2",
    ),
    Mistake(
        "ramps-way-forgotten",
        "the cruise starts at 0; it has to start where the ramp ended",
        Ramps(cruising=lambda t, top, ramp: top * (t - ramp)),
        "the cruise from 0",
    ),
    Mistake(
        "ramp-at-full-speed",
        "the cruise counts the ramp as if it had been at full speed all the time",
        Ramps(cruising=lambda t, top, ramp: top * t),
        "the cruise with v t",
    ),
    Mistake(
        "does-not-stop",
        "after the end it goes on with -a, backwards",
        Ramps(stops=False),
        "the profile without its end",
    ),
    Mistake(
        "does-not-wait",
        "before the start it is on the ramp already",
        Ramps(waits=False),
        "the profile without its start",
    ),
    Mistake(
        "does-not-wait-or-stop",
        "before the start and after the end the ramps go on",
        Ramps(waits=False, stops=False),
        "the profile without its ends",
    ),
    Mistake(
        "order",
        "the order is position, speed, acceleration; here it runs backwards",
        lambda *columns: Ramps()(*columns)[:, ::-1],
        "the order acceleration, speed, position",
    ),
]

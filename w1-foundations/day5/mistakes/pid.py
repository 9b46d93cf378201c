"""Mistakes in task 5.7 `pid_step`: what is summed, bounded, used and handed back."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from labkit.judge.mistake import Mistake, each
from robo47 import control
from robo47.checks import Array


class _Call(NamedTuple):
    """The arguments of all calls: (n, 7) of the joints, (n, 1) of the numbers."""

    e: Array
    ed: Array
    old: Array
    kp: Array
    kd: Array
    ki: Array
    dt: Array
    clamp: Array

    @property
    def raw(self) -> Array:
        """The new integral before it is bounded."""
        return self.old + self.e * self.dt

    def clip(self, x: Array) -> Array:
        """Return x within +-clamp."""
        return np.clip(x, -self.clamp, self.clamp)


Part = Callable[[_Call], Array]
Use = Callable[[_Call, Array], Array]


def _step(
    new: Part = lambda c: c.clip(c.raw),
    term: Use = lambda c, new: c.ki * new,
    kept: Use = lambda c, new: new,
    springs: Part = lambda c: c.kp * c.e + c.kd * c.ed,
) -> Callable[..., tuple[Array, Array]]:
    """Return pid_step with one part made differently.

    Args:
        new: the new integral, bounded.
        term: with the new integral: its part of the acceleration.
        kept: with the new integral: what is handed back.
        springs: the rest of the acceleration.
    """

    def redo(e, ed, integral, *numbers):
        call = _Call(e, ed, integral, *(number[:, None] for number in numbers))
        made = new(call)
        return springs(call) + term(call, made), kept(call, made)

    return redo


PID = [
    Mistake(
        "dt-forgotten",
        "the error is added without dt: the sum then depends on how often you ask",
        _step(lambda c: c.clip(c.old + c.e)),
    ),
    Mistake(
        "divided-by-dt",
        "the error is divided by dt; the area of one step is the error times dt",
        _step(lambda c: c.clip(c.old + c.e / c.dt)),
    ),
    Mistake(
        "half-the-step",
        "half of e dt is added; this call's area is e dt",
        _step(lambda c: c.clip(c.old + c.e * c.dt / 2.0)),
    ),
    Mistake(
        "velocity-error-summed",
        "ed is summed in place of e: that gives the error again, not its integral",
        _step(lambda c: c.clip(c.old + c.ed * c.dt)),
    ),
    Mistake(
        "integral-sign",
        "the error is taken off the integral, not added to it",
        _step(lambda c: c.clip(c.old - c.e * c.dt)),
    ),
    Mistake(
        "integral-term-sign",
        "ki times the integral is subtracted: it pushes away from the goal, ever more",
        _step(term=lambda c, new: -c.ki * new),
    ),
    Mistake(
        "starts-anew",
        "the integral starts anew at every call; it has to go on from the one that is "
        "given",
        _step(lambda c: c.clip(c.e * c.dt)),
    ),
    Mistake(
        "never-grows",
        "the integral never changes: this call's error is not added to it",
        _step(lambda c: c.clip(c.old)),
    ),
    Mistake(
        "not-clamped",
        "the integral has no bound: it winds up while the motors are at their limit, "
        "and the arm overshoots until it has unwound",
        _step(lambda c: c.raw),
    ),
    Mistake(
        "old-sum-clamped",
        "the old sum is clamped, and then e dt is added: clamp the new one",
        _step(lambda c: c.clip(c.old) + c.e * c.dt),
    ),
    Mistake(
        "old-sum-clamped",
        "the old sum and e dt are clamped one by one, and then added: clamp the new "
        "sum",
        _step(lambda c: c.clip(c.old) + c.clip(c.e * c.dt)),
    ),
    Mistake(
        "step-clamped",
        "only e dt is clamped, and the sum can still grow without a bound: clamp the "
        "new sum",
        _step(lambda c: c.old + c.clip(c.e * c.dt)),
    ),
    Mistake(
        "frozen-at-the-limit",
        "at the limit the old value is kept; clamp the new sum to the limit",
        _step(lambda c: np.where(np.abs(c.raw) > c.clamp, c.old, c.raw)),
    ),
    Mistake(
        "frozen-at-the-limit",
        "an integral at its limit stays there for ever; an error of the other sign "
        "must be able to unwind it",
        _step(lambda c: np.where(np.abs(c.old) >= c.clamp, c.old, c.raw)),
    ),
    Mistake(
        "emptied-at-the-limit",
        "at the limit the integral becomes 0: all that it has learned is lost; clamp "
        "it to the limit",
        _step(lambda c: np.where(np.abs(c.raw) > c.clamp, 0.0, c.raw)),
    ),
    Mistake(
        "clamped-on-one-side",
        "the integral is bounded above and not below",
        _step(lambda c: np.minimum(c.raw, c.clamp)),
    ),
    Mistake(
        "clamped-on-one-side",
        "the integral is bounded below and not above",
        _step(lambda c: np.maximum(c.raw, -c.clamp)),
    ),
    Mistake(
        "never-negative",
        "the integral is kept between 0 and clamp; it must be able to be negative",
        _step(lambda c: np.clip(c.raw, 0.0, c.clamp)),
    ),
    Mistake(
        "clamped-too-late",
        "the acceleration uses the integral before it is bounded",
        _step(term=lambda c, new: c.ki * c.raw),
    ),
    Mistake(
        "bound-not-handed-back",
        "the acceleration uses the bounded integral, but the unbounded one comes back "
        "and goes on growing",
        _step(kept=lambda c, new: c.raw),
    ),
    Mistake(
        "term-clamped",
        "ki times the integral is clamped; clamp is the bound of the integral itself",
        _step(lambda c: c.clip(c.ki * c.raw) / c.ki),
    ),
    Mistake(
        "old-integral-used",
        "the acceleration uses the integral from before this step",
        _step(term=lambda c, new: c.ki * c.old),
    ),
    Mistake(
        "old-integral-kept",
        "the integral that was given comes back unchanged",
        _step(kept=lambda c, new: c.old),
    ),
    Mistake(
        "ki-forgotten",
        "the integral is added without its gain",
        _step(term=lambda c, new: new),
    ),
    Mistake(
        "no-integral-term",
        "the integral is not in the acceleration",
        _step(term=lambda c, new: 0.0 * new),
    ),
    Mistake(
        "this-step-alone-used",
        "ki multiplies this step's e dt alone; the acceleration needs the whole sum",
        _step(term=lambda c, new: c.ki * c.e * c.dt),
    ),
    Mistake(
        "dt-twice",
        "the integral is multiplied by dt once more in the acceleration; dt is in it "
        "already",
        _step(term=lambda c, new: c.ki * new * c.dt),
    ),
    Mistake(
        "ki-in-the-integral",
        "the gain is inside the integral, so clamp bounds something else",
        _step(lambda c: c.clip(c.old + c.ki * c.e * c.dt), lambda c, new: new),
    ),
    Mistake(
        "term-handed-back",
        "what comes back is ki times the integral; hand the integral itself back",
        _step(kept=lambda c, new: c.ki * new),
    ),
    Mistake(
        "springs-forgotten",
        "only the integral's part is there: kp e and kd ed are missing",
        _step(springs=lambda c: 0.0 * c.e),
    ),
    Mistake(
        "spring-forgotten", "kp e is missing", _step(springs=lambda c: c.kd * c.ed)
    ),
    Mistake(
        "damper-forgotten", "kd ed is missing", _step(springs=lambda c: c.kp * c.e)
    ),
    Mistake(
        "gains-swapped",
        "kp and kd are swapped: kp belongs to e and kd to ed",
        _step(springs=lambda c: c.kd * c.e + c.kp * c.ed),
    ),
    Mistake(
        "error-sign",
        "kp e has the wrong sign",
        _step(springs=lambda c: c.kd * c.ed - c.kp * c.e),
    ),
    Mistake(
        "velocity-error-sign",
        "kd ed has the wrong sign",
        _step(springs=lambda c: c.kp * c.e - c.kd * c.ed),
    ),
    Mistake(
        "swapped",
        "the two answers are swapped: the acceleration comes first",
        lambda *args: each(control.pid_step)(*args)[::-1],
    ),
]

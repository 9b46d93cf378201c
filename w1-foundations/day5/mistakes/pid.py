"""Mistakes in task 5.7 `pid_step`: what is summed, bounded, used and handed back."""

from collections.abc import Callable

import numpy as np

from robo47 import control
from robo47.checks import Array
from robo47.diagnose.mistake import Mistake, each


def _columns(*numbers: Array) -> list[Array]:
    return [number[:, None] for number in numbers]


def _clip(x: Array, bound: Array) -> Array:
    return np.clip(x, -bound, bound)


def _step(
    summed: Callable[..., Array] | None = None,
    bounded: Callable[..., Array] = _clip,
    used: Callable[..., Array] | None = None,
    kept: Callable[..., Array] | None = None,
    springs: Callable[..., Array] | None = None,
) -> Callable[..., tuple[Array, Array]]:
    """Return pid_step with one part made differently.

    Args:
        summed: (e, integral, dt, ki) -> the new integral before it is bounded.
        bounded: (integral, clamp) -> it bounded.
        used: (old, raw, bounded, ki) -> the term in the acceleration.
        kept: (old, raw, bounded, ki) -> what is handed back.
        springs: (e, ed, kp, kd) -> the rest of the acceleration.
    """

    def redo(e, ed, integral, kp, kd, ki, dt, clamp):
        kp, kd, ki, dt, clamp = _columns(kp, kd, ki, dt, clamp)
        raw = summed(e, integral, dt, ki) if summed else integral + e * dt
        new = bounded(raw, clamp)
        rest = springs(e, ed, kp, kd) if springs else kp * e + kd * ed
        term = used(integral, raw, new, ki) if used else ki * new
        return rest + term, kept(integral, raw, new, ki) if kept else new

    return redo


PID = [
    Mistake(
        "dt-forgotten",
        "the error is added without dt: the sum then depends on how often you ask",
        _step(summed=lambda e, old, dt, ki: old + e),
    ),
    Mistake(
        "integral-sign",
        "the error is taken off the integral, not added to it",
        _step(summed=lambda e, old, dt, ki: old - e * dt),
    ),
    Mistake(
        "integral-term-sign",
        "ki times the integral is subtracted: it pushes away from the goal, ever more",
        _step(used=lambda old, raw, new, ki: -ki * new),
    ),
    Mistake(
        "starts-anew",
        "the integral starts anew at every call; it has to go on from the one that is "
        "given",
        _step(summed=lambda e, old, dt, ki: e * dt),
    ),
    Mistake(
        "never-grows",
        "the integral never changes: this call's error is not added to it",
        _step(summed=lambda e, old, dt, ki: old),
    ),
    Mistake(
        "not-clamped",
        "the integral has no bound: it winds up while the motors are at their limit, "
        "and the arm overshoots until it has unwound",
        _step(bounded=lambda raw, clamp: raw),
    ),
    Mistake(
        "clamped-on-one-side",
        "the integral is bounded above and not below",
        _step(bounded=np.minimum),
    ),
    Mistake(
        "clamped-on-one-side",
        "the integral is bounded below and not above",
        _step(bounded=lambda raw, clamp: np.maximum(raw, -clamp)),
    ),
    Mistake(
        "never-negative",
        "the integral is kept between 0 and clamp; it must be able to be negative",
        _step(bounded=lambda raw, clamp: np.clip(raw, 0.0, clamp)),
    ),
    Mistake(
        "clamped-too-late",
        "the acceleration uses the integral before it is bounded",
        _step(used=lambda old, raw, new, ki: ki * raw),
    ),
    Mistake(
        "bound-not-handed-back",
        "the acceleration uses the bounded integral, but the unbounded one comes back "
        "and goes on growing",
        _step(kept=lambda old, raw, new, ki: raw),
    ),
    Mistake(
        "old-integral-used",
        "the acceleration uses the integral from before this step",
        _step(used=lambda old, raw, new, ki: ki * old),
    ),
    Mistake(
        "old-integral-kept",
        "the integral that was given comes back unchanged",
        _step(kept=lambda old, raw, new, ki: old),
    ),
    Mistake(
        "ki-forgotten",
        "the integral is added without its gain",
        _step(used=lambda old, raw, new, ki: new),
    ),
    Mistake(
        "no-integral-term",
        "the integral is not in the acceleration",
        _step(used=lambda old, raw, new, ki: 0.0 * new),
    ),
    Mistake(
        "ki-in-the-integral",
        "the gain is inside the integral, so clamp bounds something else",
        _step(
            summed=lambda e, old, dt, ki: old + ki * e * dt,
            used=lambda old, raw, new, ki: new,
        ),
    ),
    Mistake(
        "term-handed-back",
        "what comes back is ki times the integral; hand the integral itself back",
        _step(kept=lambda old, raw, new, ki: ki * new),
    ),
    Mistake(
        "springs-forgotten",
        "only the integral's part is there: kp e and kd ed are missing",
        _step(springs=lambda e, ed, kp, kd: 0.0 * e),
    ),
    Mistake(
        "damper-forgotten",
        "kd ed is missing",
        _step(springs=lambda e, ed, kp, kd: kp * e),
    ),
    Mistake(
        "error-sign",
        "kp e has the wrong sign",
        _step(springs=lambda e, ed, kp, kd: kd * ed - kp * e),
    ),
    Mistake(
        "velocity-error-sign",
        "kd ed has the wrong sign",
        _step(springs=lambda e, ed, kp, kd: kp * e - kd * ed),
    ),
    Mistake(
        "swapped",
        "the two answers are swapped: the acceleration comes first",
        lambda *args: each(control.pid_step)(*args)[::-1],
    ),
]

"""5.7 `pid_step(e, ed, integral, ...)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector, rounded
from labkit.judge.answers import ERROR, in_calls, of_result
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .joints import JOINTS, ONE, errors, seven

KINDS = (
    Vector((7,), "rad/s2", scale=100.0, names=JOINTS, called="the acceleration"),
    Vector((7,), "rad s", scale=0.1, names=JOINTS, called="the integral"),
)
NAMES = ("acceleration", "integral")


def which_answer(case: Case) -> Finding:
    """Say which of the two results is wrong, in how many calls, and how far."""
    parts = list(zip(case.ask.kinds, case.S, case.T, strict=True))
    off = np.array([np.abs(S - T).max(axis=1) / kind.scale for kind, S, T in parts])
    wrong = off > case.ask.near
    bad = [bool(some.any()) for some in wrong]
    at = 0 if bad == [True, False] else 1  # where both are wrong: the integral first
    kind, S, T = parts[at]
    rest = f"Your {NAMES[1 - at]} is correct."
    if all(bad):
        rest = "Both of your results are wrong."
    often = f"Your {NAMES[at]} is wrong {in_calls(int(wrong[at].sum()), len(S))}."
    what = kind.what_is_wrong(S, T).message
    if not what.startswith(ERROR):
        what = of_result(what, f"your {NAMES[at]}")
    says = f"{rest} {often} {what}"
    return Finding(f"{NAMES[at]}-wrong", says)


row = Row(KINDS, unnamed=which_answer, before_slips=False)


@row.inputs
def _(rng):
    yield ONE, 0.0 * ONE, 0.0 * ONE, 400.0, 40.0, 4000.0, 0.1, 1.0
    yield from at_the_clamp(rng)
    yield 3.0 * ONE, 0.0 * ONE, -1.5 * ONE, 400.0, 40.0, 4000.0, 0.1, 2.0
    for clamp in (0.05, 10.0, 0.2, 0.1, 10.0, 0.15, 0.02, 10.0, 0.1):
        kp, kd, ki = (float(x) for x in rng.numbers(1, 9, 3))
        dt = float(rng.numbers(0.002, 0.02))
        before = np.clip(seven(rng, -0.2, 0.2), -clamp, clamp)
        yield *errors(rng), before, 50 * kp, 5 * kd, 500 * ki, dt, clamp


def at_the_clamp(rng):
    """Step over the clamp, to its other side, outwards from outside; and not."""
    sides = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
    near, over = seven(rng, 0.27, 0.29) * sides, seven(rng, 0.5, 0.6) * sides
    out = seven(rng, 0.2, 0.29) * sides
    some = out * np.array([1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0])  # one stays inside
    gains = 400.0, 40.0, 4000.0
    steps = (
        (some, near, 0.15),
        (rounded(-20.0 * out), near, 0.15),
        (out, over, 0.1),
    )
    for e, old, dt in steps:
        yield e, seven(rng, -2, 2), old, *gains, dt, 0.3
    yield 0.0 * ONE, seven(rng, -2, 2), near + 0.0, *gains, 0.01, 0.3


def summed(sums):
    """Take mistakes of the integral alone: a function that returns {slug: integral}."""

    def law(e, ed, integral, kp, kd, ki, dt, clamp):
        springs = kp * e + kd * ed
        found = sums(e, ed, integral, ki, dt, clamp)
        return {slug: (springs + ki * new, new) for slug, new in found.items()}

    law.__doc__ = sums.__doc__
    row.wrongs(law)


@summed
def _(e, ed, integral, ki, dt, clamp):
    """trapezoid-of-the-error: your code integrates the mean of e and e - ed dt, an
      estimate of the previous error. Add e dt to the integral instead
    trapezoid-of-the-error 2: your code integrates the mean of e and e + ed dt, an
      estimate of the next error. Add e dt to the integral instead
    old-sum-clamped: the sum of the old integral and e dt is not clamped in your result.
      Add e dt first, and then clamp the integral
    error-clamped: your code clamps the error instead of the integral, so the integral
      can still grow without bound. Add e dt first, and then clamp the integral
    step-clamped: your code clamps only e dt, so the integral can still grow without
      bound. Add e dt first, and then clamp the integral
    frozen-at-the-limit: your code keeps the old integral if the new integral exceeds
      the limit. Clamp the new integral to the limit instead
    emptied-at-the-limit: your code resets the integral to 0 if the integral exceeds the
      limit. Clamp the integral to the limit instead
    clamped-on-one-side: your code clamps the integral only at the upper limit. Clamp
      the integral at the lower limit too
    clamped-on-one-side 2: your code clamps the integral only at the lower limit. Clamp
      the integral at the upper limit too
    never-negative: your code clamps the integral to the range from 0 to `clamp`. The
      lower limit should be `-clamp`
    clamped-as-a-vector: your code limits the norm of the integral to `clamp`. Clamp
      each joint's integral separately instead
    term-clamped: your code clamps ki times the integral. Clamp the integral itself,
      because the argument `clamp` is the limit of the integral
    old-sum-clamped 2: your code clamps the old integral and e dt separately. Clamp
      their sum instead
    frozen-at-the-limit 2: your code never changes an integral that is at its limit. An
      error of the opposite sign should reduce the magnitude of this integral
    """
    step = e * dt
    new = integral + e * dt
    old = np.clip(integral, -clamp, clamp)
    length = max(np.linalg.norm(new), 1e-12)
    return {
        "trapezoid-of-the-error": np.clip(new - ed * dt**2 / 2, -clamp, clamp),
        "trapezoid-of-the-error 2": np.clip(new + ed * dt**2 / 2, -clamp, clamp),
        "old-sum-clamped": old + step,
        "error-clamped": integral + np.clip(e, -clamp, clamp) * dt,
        "step-clamped": integral + np.clip(step, -clamp, clamp),
        "frozen-at-the-limit": np.where(np.abs(new) > clamp, integral, new),
        "emptied-at-the-limit": np.where(np.abs(new) > clamp, 0.0, new),
        "clamped-on-one-side": np.minimum(new, clamp),
        "clamped-on-one-side 2": np.maximum(new, -clamp),
        "never-negative": np.clip(new, 0.0, clamp),
        "clamped-as-a-vector": new * min(1.0, clamp / length),
        "term-clamped": np.clip(ki * new, -clamp, clamp) / ki,
        "old-sum-clamped 2": old + np.clip(step, -clamp, clamp),
        "frozen-at-the-limit 2": np.where(np.abs(integral) >= clamp, integral, new),
    }


@row.wrongs
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    """clamped-too-late: your code computes the acceleration from the unclamped
      integral. Use the clamped integral instead
    bound-not-handed-back: your code returns the unclamped integral. Return the clamped
      integral instead, so that the integral cannot grow without bound
    old-integral-used: your acceleration contains the integral of the previous step. Use
      the updated integral instead
    old-integral-kept: your code returns the old integral. Return the updated integral
      instead
    this-step-alone-used: your acceleration contains ki times the current e dt alone.
      Multiply the whole integral by ki
    ki-in-the-integral: your integral already contains ki, so `clamp` no longer limits
      the integral of the error. Multiply the integral by ki only in the acceleration
    term-handed-back: your code returns ki times the integral. Return the integral
      itself
    swapped: your code swaps the two outputs. The acceleration should be first
    """
    raw = integral + e * dt
    springs = kp * e + kd * ed
    new, scaled = (np.clip(x, -clamp, clamp) for x in (raw, integral + ki * e * dt))
    acc = springs + ki * new
    return {
        "clamped-too-late": (springs + ki * raw, new),
        "bound-not-handed-back": (acc, raw),
        "old-integral-used": (springs + ki * integral, new),
        "old-integral-kept": (acc, integral.copy()),
        "this-step-alone-used": (springs + ki * e * dt, new),
        "ki-in-the-integral": (springs + scaled, scaled),
        "term-handed-back": (acc, ki * new),
        "swapped": (new, acc),
    }


@row.right  # A list of two, in plain Python.
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = [min(max(i + x * dt, -clamp), clamp) for i, x in zip(integral, e)]
    return [kp * e + kd * ed + ki * np.array(new), new]


row.at_least_0(
    kp="a gain",
    kd="a gain",
    ki="a gain",
    dt="a time step",
    clamp="a limit in both directions",
)


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 4e-06 * e,),
    ed=(lambda ed: 6e-06 * ed,),
    integral=(lambda integral: 2e-06 * integral,),
    clamp=(0.005,),
)

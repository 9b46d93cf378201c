"""5.7 `pid_step(e, ed, integral, ...)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector, rounded
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .joints import JOINTS, ONE, errors, seven

KINDS = (
    Vector((7,), "rad/s2", scale=100.0, names=JOINTS, called="the acceleration"),
    Vector((7,), "rad s", scale=0.1, names=JOINTS, called="the integral"),
)
NAMES = ("acceleration", "integral")


def which_answer(case: Case) -> Finding:
    """Say which of the two answers is wrong, how far, and for how many inputs."""
    parts = list(zip(case.ask.kinds, case.S, case.T, strict=True))
    off = np.array([np.abs(S - T).max(axis=1) / kind.scale for kind, S, T in parts])
    wrong = off > case.ask.near
    bad = [bool(some.any()) for some in wrong]
    at = 0 if bad == [True, False] else 1  # where both are wrong: the integral first
    kind, S, T = parts[at]
    says = (
        f"{kind.called[0].upper()}{kind.called[1:]}: {kind.what_is_wrong(S, T).message}"
    )
    rest = "The integral that comes back is right, the acceleration is not."
    if bad == [False, True]:
        rest = "The acceleration is right, the integral that comes back is not."
    if all(bad):
        rest = "Both answers are wrong; look at the integral first."
    count = int(np.sum(~wrong.any(axis=0)))
    where = f" Right for {count} of {len(S)} inputs." if count else ""
    return Finding(f"{NAMES[at]}-wrong", f"{rest} {says}{where}")


row = Row(KINDS, unnamed=which_answer)


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
    """dt-forgotten: the error is added without dt: the sum then depends on how often
      you ask
    divided-by-dt: the error is divided by dt; the area of one step is the error times
      dt
    half-the-step: half of e dt is added; this call's area is e dt
    velocity-error-summed: ed is summed instead of e: that gives the error again, not
      its integral
    integral-sign: the error is taken off the integral, not added to it
    starts-anew: the integral starts anew at every call; it has to go on from the one
      that is given
    never-grows: the integral never changes: this call's error is not added to it
    trapezoid-of-the-error: ed is in the area, as the mean of this error and the one
      before; this call's area is e dt
    trapezoid-of-the-error 2: ed is in the area, as the mean of this error and the next;
      this call's area is e dt
    """
    sums = {
        "dt-forgotten": integral + e,
        "divided-by-dt": integral + e / dt,
        "half-the-step": integral + e * dt / 2.0,
        "velocity-error-summed": integral + ed * dt,
        "integral-sign": integral - e * dt,
        "starts-anew": e * dt,
        "never-grows": integral,
        "trapezoid-of-the-error": integral + (e - ed * dt / 2) * dt,
        "trapezoid-of-the-error 2": integral + (e + ed * dt / 2) * dt,
    }
    return {slug: np.clip(new, -clamp, clamp) for slug, new in sums.items()}


@summed
def _(e, ed, integral, ki, dt, clamp):
    """not-clamped: the integral has no bound: it winds up while the motors are at their
      limit, and the arm overshoots until it has unwound
    old-sum-clamped: the old sum is clamped, and then e dt is added: clamp the new one
    error-clamped: the error is clamped, and the sum can still grow without a bound:
      clamp the new sum
    step-clamped: only e dt is clamped, and the sum can still grow without a bound:
      clamp the new sum
    frozen-at-the-limit: at the limit the old value is kept; clamp the new sum to the
      limit
    emptied-at-the-limit: at the limit the integral becomes 0: all that it has learned
      is lost; clamp it to the limit
    clamped-on-one-side: the integral is bounded above and not below
    never-negative: the integral is kept between 0 and clamp; it must be able to be
      negative
    clamped-as-a-vector: the length of all seven together is kept within clamp; each
      joint's integral has that bound for itself
    term-clamped: ki times the integral is clamped; clamp is the bound of the integral
      itself
    old-sum-clamped 2: the old sum and e dt are clamped one by one, and then added:
      clamp the new sum
    frozen-at-the-limit 2: an integral at its limit stays there for ever; an error of
      the other sign must be able to unwind it
    clamped-on-one-side 2: the integral is bounded below and not above
    """
    step = e * dt
    new = integral + e * dt
    old = np.clip(integral, -clamp, clamp)
    length = max(np.linalg.norm(new), 1e-12)
    return {
        "not-clamped": new,
        "old-sum-clamped": old + step,
        "error-clamped": integral + np.clip(e, -clamp, clamp) * dt,
        "step-clamped": integral + np.clip(step, -clamp, clamp),
        "frozen-at-the-limit": np.where(np.abs(new) > clamp, integral, new),
        "emptied-at-the-limit": np.where(np.abs(new) > clamp, 0.0, new),
        "clamped-on-one-side": np.minimum(new, clamp),
        "never-negative": np.clip(new, 0.0, clamp),
        "clamped-as-a-vector": new * min(1.0, clamp / length),
        "term-clamped": np.clip(ki * new, -clamp, clamp) / ki,
        "old-sum-clamped 2": old + np.clip(step, -clamp, clamp),
        "frozen-at-the-limit 2": np.where(np.abs(integral) >= clamp, integral, new),
        "clamped-on-one-side 2": np.maximum(new, -clamp),
    }


@row.wrongs
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    """integral-term-sign: ki times the integral is subtracted: it pushes away from the
      goal, ever more
    clamped-too-late: the acceleration uses the integral before it is bounded
    bound-not-handed-back: the acceleration uses the bounded integral, but the unbounded
      one comes back and goes on growing
    old-integral-used: the acceleration uses the integral from before this step
    old-integral-kept: the integral that was given comes back unchanged
    ki-forgotten: the integral is added without its gain
    no-integral-term: the integral is not in the acceleration
    this-step-alone-used: ki multiplies this step's e dt alone; the acceleration needs
      the whole sum
    dt-twice: the integral is multiplied by dt once more in the acceleration; dt is in
      it already
    ki-in-the-integral: the gain is inside the integral, so clamp bounds something else
    term-handed-back: what comes back is ki times the integral; hand the integral itself
      back
    swapped: the two answers are swapped: the acceleration comes first
    """
    raw = integral + e * dt
    springs = kp * e + kd * ed
    new, scaled = (np.clip(x, -clamp, clamp) for x in (raw, integral + ki * e * dt))
    acc = springs + ki * new
    return {
        "integral-term-sign": (springs - ki * new, new),
        "clamped-too-late": (springs + ki * raw, new),
        "bound-not-handed-back": (acc, raw),
        "old-integral-used": (springs + ki * integral, new),
        "old-integral-kept": (acc, integral.copy()),
        "ki-forgotten": (springs + new, new),
        "no-integral-term": (springs, new),
        "this-step-alone-used": (springs + ki * e * dt, new),
        "dt-twice": (springs + ki * new * dt, new),
        "ki-in-the-integral": (springs + scaled, scaled),
        "term-handed-back": (acc, ki * new),
        "swapped": (new, acc),
    }


@row.wrongs
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    """springs-forgotten: only the integral's part is there: kp e and kd ed are missing
    spring-forgotten: kp e is missing
    damper-forgotten: kd ed is missing
    gains-swapped: kp and kd are swapped: kp belongs to e and kd to ed
    error-sign: kp e has the wrong sign
    velocity-error-sign: kd ed has the wrong sign
    """
    new = np.clip(integral + e * dt, -clamp, clamp)
    springs = {
        "springs-forgotten": 0.0,
        "spring-forgotten": kd * ed,
        "damper-forgotten": kp * e,
        "gains-swapped": kd * e + kp * ed,
        "error-sign": kd * ed - kp * e,
        "velocity-error-sign": kp * e - kd * ed,
    }
    return {slug: (some + ki * new, new) for slug, some in springs.items()}


@row.right  # A list of two, in plain Python.
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = [min(max(i + x * dt, -clamp), clamp) for i, x in zip(integral, e)]
    return [kp * e + kd * ed + ki * np.array(new), new]


row.at_least_0(
    kp="a gain",
    kd="a gain",
    ki="a gain",
    dt="a step of time",
    clamp="a bound on both sides",
)


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 4e-06 * e,),
    ed=(lambda ed: 6e-06 * ed,),
    integral=(lambda integral: 2e-06 * integral,),
    clamp=(0.005,),
)

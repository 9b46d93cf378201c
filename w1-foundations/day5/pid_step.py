"""5.7 `pid_step(e, ed, integral, ...)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from labkit.judge.row import Row

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
    for clamp in (0.05, 10.0, 0.2, 0.1, 10.0, 0.15, 0.02, 10.0, 0.1):
        kp, kd, ki = (float(x) for x in draw.numbers(rng, 1, 9, 3))
        dt = float(draw.numbers(rng, 0.002, 0.02))
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
        (draw.rounded(-20.0 * out), near, 0.15),
        (out, over, 0.1),
    )
    for e, old, dt in steps:
        yield e, seven(rng, -2, 2), old, *gains, dt, 0.3
    yield 0.0 * ONE, seven(rng, -2, 2), near + 0.0, *gains, 0.01, 0.3


@row.wrong
def dt_forgotten(e, ed, integral, kp, kd, ki, dt, clamp):
    """the error is added without dt: the sum then depends on how often you ask"""
    integral = np.clip(integral + e, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def divided_by_dt(e, ed, integral, kp, kd, ki, dt, clamp):
    """the error is divided by dt; the area of one step is the error times dt"""
    integral = np.clip(integral + e / dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def half_the_step(e, ed, integral, kp, kd, ki, dt, clamp):
    """half of e dt is added; this call's area is e dt"""
    integral = np.clip(integral + e * dt / 2.0, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def velocity_error_summed(e, ed, integral, kp, kd, ki, dt, clamp):
    """ed is summed instead of e: that gives the error again, not its integral"""
    integral = np.clip(integral + ed * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def integral_sign(e, ed, integral, kp, kd, ki, dt, clamp):
    """the error is taken off the integral, not added to it"""
    integral = np.clip(integral - e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def integral_term_sign(e, ed, integral, kp, kd, ki, dt, clamp):
    """ki times the integral is subtracted: it pushes away from the goal, ever more"""
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed - ki * integral, integral


@row.wrong
def starts_anew(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral starts anew at every call; it has to go on from the one that is
    given"""
    integral = np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def never_grows(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral never changes: this call's error is not added to it"""
    integral = np.clip(integral, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def not_clamped(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral has no bound: it winds up while the motors are at their limit, and
    the arm overshoots until it has unwound"""
    integral = integral + e * dt
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def old_sum_clamped(e, ed, integral, kp, kd, ki, dt, clamp):
    """the old sum is clamped, and then e dt is added: clamp the new one"""
    integral = np.clip(integral, -clamp, clamp) + e * dt
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def old_sum_clamped(e, ed, integral, kp, kd, ki, dt, clamp):
    """the old sum and e dt are clamped one by one, and then added: clamp the new sum"""
    integral = np.clip(integral, -clamp, clamp) + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def step_clamped(e, ed, integral, kp, kd, ki, dt, clamp):
    """only e dt is clamped, and the sum can still grow without a bound: clamp the new
    sum"""
    integral = integral + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def frozen_at_the_limit(e, ed, integral, kp, kd, ki, dt, clamp):
    """at the limit the old value is kept; clamp the new sum to the limit"""
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, integral, raw)
    return kp * e + kd * ed + ki * new, new


@row.wrong
def frozen_at_the_limit(e, ed, integral, kp, kd, ki, dt, clamp):
    """an integral at its limit stays there for ever; an error of the other sign must be
    able to unwind it"""
    integral = np.where(np.abs(integral) >= clamp, integral, integral + e * dt)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def emptied_at_the_limit(e, ed, integral, kp, kd, ki, dt, clamp):
    """at the limit the integral becomes 0: all that it has learned is lost; clamp it to
    the limit"""
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, 0.0, raw)
    return kp * e + kd * ed + ki * new, new


@row.wrong
def clamped_on_one_side(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral is bounded above and not below"""
    integral = np.minimum(integral + e * dt, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def clamped_on_one_side(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral is bounded below and not above"""
    integral = np.maximum(integral + e * dt, -clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def never_negative(e, ed, integral, kp, kd, ki, dt, clamp):
    """the integral is kept between 0 and clamp; it must be able to be negative"""
    integral = np.clip(integral + e * dt, 0.0, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong
def clamped_too_late(e, ed, integral, kp, kd, ki, dt, clamp):
    """the acceleration uses the integral before it is bounded"""
    integral = integral + e * dt
    return kp * e + kd * ed + ki * integral, np.clip(integral, -clamp, clamp)


@row.wrong
def bound_not_handed_back(e, ed, integral, kp, kd, ki, dt, clamp):
    """the acceleration uses the bounded integral, but the unbounded one comes back and
    goes on growing"""
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, integral + e * dt


@row.wrong
def clamped_as_a_vector(e, ed, integral, kp, kd, ki, dt, clamp):
    """the length of all seven together is kept within clamp; each joint's integral has
    that bound for itself"""
    new = integral + e * dt
    new = new * min(1.0, clamp / max(np.linalg.norm(new), 1e-12))
    return kp * e + kd * ed + ki * new, new


@row.wrong
def trapezoid_of_the_error(e, ed, integral, kp, kd, ki, dt, clamp):
    """ed is in the area, as the mean of this error and the one before; this call's area
    is e dt"""
    new = np.clip(integral + (e - ed * dt / 2) * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new


@row.wrong
def trapezoid_of_the_error(e, ed, integral, kp, kd, ki, dt, clamp):
    """ed is in the area, as the mean of this error and the next; this call's area is
    e dt"""
    new = np.clip(integral + (e + ed * dt / 2) * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new


@row.wrong
def term_clamped(e, ed, integral, kp, kd, ki, dt, clamp):
    """ki times the integral is clamped; clamp is the bound of the integral itself"""
    integral = np.clip(ki * (integral + e * dt), -clamp, clamp) / ki
    return kp * e + kd * ed + ki * integral, integral


@row.wrongs
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    """old-integral-used: the acceleration uses the integral from before this step
    old-integral-kept: the integral that was given comes back unchanged
    ki-forgotten: the integral is added without its gain
    no-integral-term: the integral is not in the acceleration
    this-step-alone-used: ki multiplies this step's e dt alone; the acceleration needs
      the whole sum
    dt-twice: the integral is multiplied by dt once more in the acceleration; dt is in
      it already
    """
    new = np.clip(integral + e * dt, -clamp, clamp)
    return {
        "old-integral-used": (kp * e + kd * ed + ki * integral, new),
        "old-integral-kept": (kp * e + kd * ed + ki * new, integral.copy()),
        "ki-forgotten": (kp * e + kd * ed + new, new),
        "no-integral-term": (kp * e + kd * ed, new),
        "this-step-alone-used": (kp * e + kd * ed + ki * e * dt, new),
        "dt-twice": (kp * e + kd * ed + ki * new * dt, new),
    }


@row.wrong
def ki_in_the_integral(e, ed, integral, kp, kd, ki, dt, clamp):
    """the gain is inside the integral, so clamp bounds something else"""
    integral = np.clip(integral + ki * e * dt, -clamp, clamp)
    return kp * e + kd * ed + integral, integral


@row.wrongs
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    """term-handed-back: what comes back is ki times the integral; hand the integral
      itself back
    springs-forgotten: only the integral's part is there: kp e and kd ed are missing
    spring-forgotten: kp e is missing
    damper-forgotten: kd ed is missing
    gains-swapped: kp and kd are swapped: kp belongs to e and kd to ed
    error-sign: kp e has the wrong sign
    velocity-error-sign: kd ed has the wrong sign
    """
    new = np.clip(integral + e * dt, -clamp, clamp)
    return {
        "term-handed-back": (kp * e + kd * ed + ki * new, ki * new),
        "springs-forgotten": (ki * new, new),
        "spring-forgotten": (kd * ed + ki * new, new),
        "damper-forgotten": (kp * e + ki * new, new),
        "gains-swapped": (kd * e + kp * ed + ki * new, new),
        "error-sign": (kd * ed - kp * e + ki * new, new),
        "velocity-error-sign": (kp * e - kd * ed + ki * new, new),
    }


@row.wrong
def swapped(e, ed, integral, kp, kd, ki, dt, clamp):
    """the two answers are swapped: the acceleration comes first"""
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return integral, kp * e + kd * ed + ki * integral


@row.right  # A list of two, in plain Python.
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = [min(max(i + x * dt, -clamp), clamp) for i, x in zip(integral, e)]
    return [kp * e + kd * ed + ki * np.array(new), new]

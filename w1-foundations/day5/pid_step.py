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


@row.wrong(
    "dt-forgotten",
    "the error is added without dt: the sum then depends on how often you ask",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "divided-by-dt",
    "the error is divided by dt; the area of one step is the error times dt",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e / dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong("half-the-step", "half of e dt is added; this call's area is e dt")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt / 2.0, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "velocity-error-summed",
    "ed is summed in place of e: that gives the error again, not its integral",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + ed * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong("integral-sign", "the error is taken off the integral, not added to it")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral - e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "integral-term-sign",
    "ki times the integral is subtracted: it pushes away from the goal, ever more",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed - ki * integral, integral


@row.wrong(
    "starts-anew",
    "the integral starts anew at every call; it has to go on from the one that is "
    "given",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "never-grows", "the integral never changes: this call's error is not added to it"
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "not-clamped",
    "the integral has no bound: it winds up while the motors are at their limit, and "
    "the arm overshoots until it has unwound",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = integral + e * dt
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "old-sum-clamped",
    "the old sum is clamped, and then e dt is added: clamp the new one",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral, -clamp, clamp) + e * dt
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "old-sum-clamped",
    "the old sum and e dt are clamped one by one, and then added: clamp the new sum",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral, -clamp, clamp) + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "step-clamped",
    "only e dt is clamped, and the sum can still grow without a bound: clamp the new "
    "sum",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = integral + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "frozen-at-the-limit",
    "at the limit the old value is kept; clamp the new sum to the limit",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, integral, raw)
    return kp * e + kd * ed + ki * new, new


@row.wrong(
    "frozen-at-the-limit",
    "an integral at its limit stays there for ever; an error of the other sign must "
    "be able to unwind it",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.where(np.abs(integral) >= clamp, integral, integral + e * dt)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "emptied-at-the-limit",
    "at the limit the integral becomes 0: all that it has learned is lost; clamp it "
    "to the limit",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, 0.0, raw)
    return kp * e + kd * ed + ki * new, new


@row.wrong("clamped-on-one-side", "the integral is bounded above and not below")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.minimum(integral + e * dt, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong("clamped-on-one-side", "the integral is bounded below and not above")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.maximum(integral + e * dt, -clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "never-negative",
    "the integral is kept between 0 and clamp; it must be able to be negative",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, 0.0, clamp)
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "clamped-too-late", "the acceleration uses the integral before it is bounded"
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = integral + e * dt
    return kp * e + kd * ed + ki * integral, np.clip(integral, -clamp, clamp)


@row.wrong(
    "bound-not-handed-back",
    "the acceleration uses the bounded integral, but the unbounded one comes back and "
    "goes on growing",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, integral + e * dt


@row.wrong(
    "term-clamped",
    "ki times the integral is clamped; clamp is the bound of the integral itself",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(ki * (integral + e * dt), -clamp, clamp) / ki
    return kp * e + kd * ed + ki * integral, integral


@row.wrong(
    "old-integral-used", "the acceleration uses the integral from before this step"
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, new


@row.wrong("old-integral-kept", "the integral that was given comes back unchanged")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, integral.copy()


@row.wrong("ki-forgotten", "the integral is added without its gain")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + new, new


@row.wrong("no-integral-term", "the integral is not in the acceleration")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed, new


@row.wrong(
    "this-step-alone-used",
    "ki multiplies this step's e dt alone; the acceleration needs the whole sum",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * e * dt, new


@row.wrong(
    "dt-twice",
    "the integral is multiplied by dt once more in the acceleration; dt is in it "
    "already",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new * dt, new


@row.wrong(
    "ki-in-the-integral",
    "the gain is inside the integral, so clamp bounds something else",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + ki * e * dt, -clamp, clamp)
    return kp * e + kd * ed + integral, integral


@row.wrong(
    "term-handed-back",
    "what comes back is ki times the integral; hand the integral itself back",
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, ki * new


@row.wrong(
    "springs-forgotten", "only the integral's part is there: kp e and kd ed are missing"
)
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return ki * new, new


@row.wrong("spring-forgotten", "kp e is missing")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kd * ed + ki * new, new


@row.wrong("damper-forgotten", "kd ed is missing")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + ki * new, new


@row.wrong("gains-swapped", "kp and kd are swapped: kp belongs to e and kd to ed")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kd * e + kp * ed + ki * new, new


@row.wrong("error-sign", "kp e has the wrong sign")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kd * ed - kp * e + ki * new, new


@row.wrong("velocity-error-sign", "kd ed has the wrong sign")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e - kd * ed + ki * new, new


@row.wrong("swapped", "the two answers are swapped: the acceleration comes first")
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return integral, kp * e + kd * ed + ki * integral


@row.right  # A list of two, in plain Python.
def _(e, ed, integral, kp, kd, ki, dt, clamp):
    new = [min(max(i + x * dt, -clamp), clamp) for i, x in zip(integral, e)]
    return [kp * e + kd * ed + ki * np.array(new), new]

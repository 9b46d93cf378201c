"""9.2 `delay_margin(kp, kd)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(unit="s", scale=0.01))


@row.inputs
def _(rng):
    kp, kd = rng.numbers(20, 900, 6), rng.numbers(4, 60, 6)
    pairs = zip(kp.tolist(), kd.tolist(), strict=True)
    return [(400.0, 40.0), (1600.0, 80.0), *pairs]


def margin(
    kp, kd, *, w=lambda kp, kd: np.sqrt((kd**2 + np.sqrt(kd**4 + 4 * kp**2)) / 2),
    angle=lambda kp, kd, w: np.arctan(kd * w / kp), by=lambda w: w,
):  # fmt: skip
    """Return the margin with another w, another angle or another divisor."""
    found = w(kp, kd)
    return angle(kp, kd, found) / by(found)


for slug, says, other in (
    ("at-omega",
     "your code uses sqrt(kp) as the crossover frequency w, which ignores the "
     "derivative term. Solve w^4 = kp^2 + kd^2 w^2 for w instead",
     {"w": lambda kp, kd: np.sqrt(kp)}),
    ("at-kd",
     "your code uses kd as the crossover frequency w, which ignores the proportional "
     "term. Solve w^4 = kp^2 + kd^2 w^2 for w instead",
     {"w": lambda kp, kd: kd}),
    ("strengths-added",
     "your code uses kp + kd^2 as w^2. Solve w^4 = kp^2 + kd^2 w^2 instead, because "
     "the two terms differ in phase by 90 degrees",
     {"w": lambda kp, kd: np.sqrt(kp + kd**2)}),
    ("minus-in-the-root",
     "your code subtracts 4 kp^2 under the inner root. Add 4 kp^2 instead, because w^2 "
     "is the positive root of x^2 - kd^2 x - kp^2 = 0",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(abs(kd**4 - 4 * kp**2))) / 2)}),
    ("half-left-out",
     "your code does not halve kd^2 in the quadratic formula. The formula should give "
     "w^2 = kd^2 / 2 + sqrt(kd^4 / 4 + kp^2)",
     {"w": lambda kp, kd: np.sqrt(kd**2 + np.sqrt(kd**4 + kp**2))}),
    ("neither-squared",
     "your code uses kd and kp instead of their squares in the quadratic formula. Use "
     "kd^2, kd^4 and kp^2, because the unknown of the quadratic equation is w^2",
     {"w": lambda kp, kd: np.sqrt((kd + np.sqrt(kd**2 + 4 * kp)) / 2)}),
    ("inverted",
     "your phase lead is atan(kp / (kd w)), which is 90 degrees minus the correct "
     "phase lead. It should be atan(kd w / kp), which is 0 for kd = 0",
     {"angle": lambda kp, kd, w: np.arctan(kp / (kd * w))}),
    ("from-the-far-side",
     "your code uses pi minus the phase lead as the phase margin. The phase margin is "
     "the phase lead itself, because it is measured from -180 degrees",
     {"angle": lambda kp, kd, w: np.pi - np.arctan(kd * w / kp)}),
    ("in-cycles",
     "your result is too large by the factor 2 pi, as with the frequency in Hz. Divide "
     "the phase lead by w in rad/s instead, because the phase lead is in radians",
     {"by": lambda w: w / (2 * np.pi)}),
):  # fmt: skip
    row.wrong(slug, says)(partial(margin, **other))


@row.wrongs
def _(kp, kd):
    """critical-only: your code returns 0.6474 / sqrt(kp), which is the delay margin
      only for critical damping. Divide the phase lead atan(kd w / kp) by the crossover
      frequency w instead
    damper-alone: your code returns pi / (2 kd), which is the delay margin only for kp =
      0. Divide the phase lead atan(kd w / kp) by the crossover frequency w instead
    """
    return {"critical-only": 0.6474 / np.sqrt(kp), "damper-alone": np.pi / 2 / kd}


@row.right  # The phase of the loop at the frequency that bisection finds.
def _(kp, kd):
    low, high = 0.0, 10 * (kd + np.sqrt(kp))
    for _ in range(200):
        w = (low + high) / 2
        low, high = (w, high) if kp**2 + (kd * w) ** 2 > w**4 else (low, w)
    return np.angle(kp + 1j * kd * w) / w


row.at_least_0(kp="a gain", kd="a gain", answer="a time")

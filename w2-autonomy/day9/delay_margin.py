"""9.2 `delay_margin(kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.estimation import delay_margin

row = Row(Scalar(unit="s", scale=0.01))


@row.inputs
def _(rng):
    kp, kd = rng.numbers(20, 900, 6), rng.numbers(4, 60, 6)
    pairs = zip(kp.tolist(), kd.tolist(), strict=True)
    return [(400.0, 40.0), (1600.0, 80.0), *pairs]


@row.wrongs
def _(kp, kd):
    """angle-for-time: this is the angle that is left; divided by w it is a time => the
      right one times w
    at-omega: w is sqrt(kp), where the spring alone balances the inertia; the damper
      pushes as well, so they are as strong as it at a larger w => with w = sqrt(kp)
    w-not-rooted: w is not rooted: the formula gives w^2 => with w^2 for w
    not-halved: the half is missing in w^2 = (kd^2 + sqrt(...)) / 2
    two-for-four: 4 kp^2 is 2 kp^2 in the root
    kp-not-squared: kp is not squared in the root => with 4 kp
    inverted: kp stands above, kd w below: that is the angle to the damper's axis; the
      damper's share is above => with atan(kp / (kd w))
    w-left-out-of-the-angle: the damper's side is kd; it is kd w => with atan(kd / kp)
    in-degrees: the angle is in degrees; w is in radians a second
    critical-only: this is 0.6474 / sqrt(kp), which holds at critical damping alone
    damper-alone: this is the damper's own, pi / 2 / kd; the spring takes part of it
    from-the-far-side: the angle is pi minus the right one: what is left until -180
      degrees, where the loop stands, is the damper's lead itself
    tangent-not-undone: it is kd w / kp itself; that is the tangent of the angle
    """
    w = np.sqrt((kd**2 + np.sqrt(kd**4 + 4 * kp**2)) / 2)

    def at(w, angle=lambda w: np.arctan(kd * w / kp)):
        return angle(w) / w

    return {
        "angle-for-time": delay_margin(kp, kd) * w,
        "at-omega": at(np.sqrt(kp)),
        "w-not-rooted": at(w * w),
        "not-halved": at(w * np.sqrt(2)),
        "two-for-four": at(np.sqrt((kd**2 + np.sqrt(kd**4 + 2 * kp**2)) / 2)),
        "kp-not-squared": at(np.sqrt((kd**2 + np.sqrt(kd**4 + 4 * kp)) / 2)),
        "inverted": at(w, lambda w: np.arctan(kp / (kd * w))),
        "w-left-out-of-the-angle": at(w, lambda w: np.arctan(kd / kp)),
        "in-degrees": np.rad2deg(at(w)),
        "critical-only": 0.6474 / np.sqrt(kp),
        "damper-alone": np.pi / 2 / kd,
        "from-the-far-side": at(w, lambda w: np.pi - np.arctan(kd * w / kp)),
        "tangent-not-undone": kd / kp,
    }


@row.right  # The phase of the loop at the frequency that bisection finds.
def _(kp, kd):
    low, high = 0.0, 10 * (kd + np.sqrt(kp))
    for _ in range(200):
        w = (low + high) / 2
        low, high = (w, high) if kp**2 + (kd * w) ** 2 > w**4 else (low, w)
    return np.angle(kp + 1j * kd * w) / w


row.at_least_0(kp="a gain", kd="a gain", answer="a time")

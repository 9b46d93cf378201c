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


def square(kp, kd):
    """Return w^2, where spring and damper together are as strong as inertia."""
    return (kd**2 + np.sqrt(kd**4 + 4 * kp**2)) / 2


def margin(
    kp, kd, *, w=lambda kp, kd: np.sqrt(square(kp, kd)),
    angle=lambda kp, kd, w: np.arctan(kd * w / kp), by=lambda w: w,
):  # fmt: skip
    """Return the margin with other parts: at which w, of which angle, divided by."""
    found = w(kp, kd)
    return angle(kp, kd, found) / by(found)


for slug, says, redone, other in (
    ("angle-for-time", "this is the angle that is left; divided by w it is a time",
     "the right one times w", {"by": lambda w: 1.0}),
    ("at-omega", "w is sqrt(kp), where the spring alone balances the inertia; the "
     "damper pushes as well, so they are as strong as it at a larger w",
     "with w = sqrt(kp)", {"w": lambda kp, kd: np.sqrt(kp)}),
    ("at-kd", "w is kd, where the damper alone balances the inertia; the spring pushes "
     "as well", "with w = kd", {"w": lambda kp, kd: kd}),
    ("w-not-rooted", "w is not rooted: the formula gives w^2", "with w^2 for w",
     {"w": square}),
    ("not-halved", "the half is missing in w^2 = (kd^2 + sqrt(...)) / 2", "without it",
     {"w": lambda kp, kd: np.sqrt(2 * square(kp, kd))}),
    ("half-of-the-root", "only the root is halved in w^2 = (kd^2 + sqrt(...)) / 2, and "
     "kd^2 is not", "with kd^2 + sqrt(...) / 2",
     {"w": lambda kp, kd: np.sqrt(kd**2 + np.sqrt(kd**4 + 4 * kp**2) / 2)}),
    ("half-of-kd", "only kd^2 is halved in w^2 = (kd^2 + sqrt(...)) / 2, and the root "
     "is not", "with kd^2 / 2 + sqrt(...)",
     {"w": lambda kp, kd: np.sqrt(kd**2 / 2 + np.sqrt(kd**4 + 4 * kp**2))}),
    ("minus-in-the-root", "4 kp^2 is taken off in the root; w^4 - kd^2 w^2 - kp^2 = 0 "
     "has + there", "with kd^4 - 4 kp^2",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(abs(kd**4 - 4 * kp**2))) / 2)}),
    ("other-root", "it is sqrt(...) - kd^2, the size of the negative root of the "
     "quadratic; w^2 is the positive one", "with sqrt(...) - kd^2",
     {"w": lambda kp, kd: np.sqrt((np.sqrt(kd**4 + 4 * kp**2) - kd**2) / 2)}),
    ("root-alone", "kd^2 is missing before the root", "with w^2 = sqrt(...) / 2",
     {"w": lambda kp, kd: np.sqrt(np.sqrt(kd**4 + 4 * kp**2) / 2)}),
    ("strengths-added", "w^2 is kp + kd^2; spring and damper push together with "
     "sqrt(kp^2 + kd^2 w^2), and that is w^2", "with w^2 = kp + kd^2",
     {"w": lambda kp, kd: np.sqrt(kp + kd**2)}),
    ("two-for-four", "4 kp^2 is 2 kp^2 in the root", "with 2 kp^2",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(kd**4 + 2 * kp**2)) / 2)}),
    ("one-for-four", "4 kp^2 is kp^2 in the root", "with kp^2",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(kd**4 + kp**2)) / 2)}),
    ("kp-not-squared", "kp is not squared in the root", "with 4 kp",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(kd**4 + 4 * kp)) / 2)}),
    ("kd-squared-for-fourth", "kd is squared in the root; there it is kd^4",
     "with kd^2 in the root",
     {"w": lambda kp, kd: np.sqrt((kd**2 + np.sqrt(kd**2 + 4 * kp**2)) / 2)}),
    ("kd-not-squared", "kd stands before the root as it is; it is kd^2",
     "with kd + sqrt(...)",
     {"w": lambda kp, kd: np.sqrt((kd + np.sqrt(kd**4 + 4 * kp**2)) / 2)}),
    ("neither-squared", "kd, kd^2 and kp stand where kd^2, kd^4 and kp^2 are right: it "
     "is a quadratic in w^2", "with (kd + sqrt(kd^2 + 4 kp)) / 2",
     {"w": lambda kp, kd: np.sqrt((kd + np.sqrt(kd**2 + 4 * kp)) / 2)}),
    ("inverted", "kp stands above, kd w below: that is the angle to the damper's axis; "
     "the damper's share is above", "with atan(kp / (kd w))",
     {"angle": lambda kp, kd, w: np.arctan(kp / (kd * w))}),
    ("w-left-out-of-the-angle", "the damper's side is kd; it is kd w",
     "with atan(kd / kp)", {"angle": lambda kp, kd, w: np.arctan(kd / kp)}),
    ("in-degrees", "the angle is in degrees; w is in radians a second", "in degrees",
     {"angle": lambda kp, kd, w: np.rad2deg(np.arctan(kd * w / kp))}),
    ("from-the-far-side", "the angle is pi minus the right one: what is left until "
     "-180 degrees, where the loop stands, is the damper's lead itself",
     "with pi - atan(kd w / kp)",
     {"angle": lambda kp, kd, w: np.pi - np.arctan(kd * w / kp)}),
    ("tangent-not-undone", "it is kd w / kp itself; that is the tangent of the angle",
     "kd / kp", {"angle": lambda kp, kd, w: kd * w / kp}),
    ("tangent-for-its-inverse", "it is the tangent of kd w / kp; the angle is the one "
     "that has it", "with tan(kd w / kp)",
     {"angle": lambda kp, kd, w: np.tan(kd * w / kp)}),
    ("times-w", "the angle is multiplied by w; divided by it, it is a time",
     "with times w", {"by": lambda w: 1 / w}),
    ("in-cycles", "it is divided by w / (2 pi), a frequency; the angle is in radians",
     "2 pi times the right one", {"by": lambda w: w / (2 * np.pi)}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(margin, **other))


@row.wrongs
def _(kp, kd):
    """critical-only: this is 0.6474 / sqrt(kp), which holds at critical damping alone
    damper-alone: this is the damper's own, pi / 2 / kd; the spring takes part of it
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

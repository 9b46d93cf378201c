"""5.7 `saturate(tau, limits)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, rounded

from .joints import ONE, TORQUE, seven

PANDA = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])

row = Row(TORQUE)


@row.inputs
def _(rng):
    yield 100.0 * ONE, PANDA
    yield rounded(PANDA * rng.uniform(-0.9, 0.9, 7)), PANDA  # within the limits
    yield 0.0 * ONE, PANDA
    for _ in range(5):
        yield seven(rng, -120, 120), PANDA
    for _ in range(4):
        yield seven(rng, -60, 60), seven(rng, 10, 60)


@row.wrongs
def _(tau, limits):
    """above-only: torques are clamped above but not below: -100 N m remains -100 N m
    below-only: torques are clamped below but not above
    sign-lost: a negative torque beyond its limit becomes positive; clamp it to minus
      the limit
    limits-typed-in: the Panda's 87 and 12 N m are typed in; use limits, because another
      arm has other limits
    smallest-limit-for-all: all joints use the smallest limit; each motor has its own
      limit
    all-scaled-down: one motor at its limit scales all seven torques down; the other
      motors can still give their torques
    length-bounded: the norm of the torque vector is compared with the limits; compare
      each torque with its own limit
    """
    length = max(np.linalg.norm(tau), 1e-300)
    return {
        "above-only": np.minimum(tau, limits),
        "below-only": np.maximum(tau, -limits),
        "sign-lost": np.where(np.abs(tau) > limits, limits, tau),
        "limits-typed-in": np.clip(tau, -PANDA, PANDA),
        "smallest-limit-for-all": np.clip(tau, -limits.min(), limits.min()),
        "all-scaled-down": tau / max(1.0, np.max(np.abs(tau) / limits)),
        "length-bounded": tau * np.minimum(1.0, limits / length),
    }


@row.wrongs
def _(tau, limits):
    """switched-off: a torque beyond its limit becomes 0; the motor can still give its
      limit
    the-larger-one: the larger one of the torque and its limit is returned; return the
      smaller one, with the sign of the torque
    always-full: every torque becomes plus or minus its limit; a torque within the
      limits should not change
    one-over-stops-all: one torque beyond its limit makes all seven torques 0; the other
      motors can still give their torques
    nothing-within-the-limits: if all torques are within their limits, the result is 0;
      they should not change
    first-limit-typed-in: the value 87 N m is typed in for all joints; use each motor's
      own entry of limits
    all-positive: all torques become positive; a motor can push in both directions
    rounded-off: the result is limits tanh(tau / limits), a smooth saturation; a torque
      within the limits should not change
    first-joint-only: only the torque of joint1 is clamped; every motor has a limit
    """
    right = np.clip(tau, -limits, limits)
    over = np.abs(tau) > limits
    return {
        "the-larger-one": np.copysign(np.maximum(np.abs(tau), limits), tau),
        "switched-off": np.where(over, 0.0, tau),
        "always-full": np.sign(tau) * limits,
        "one-over-stops-all": 0.0 * tau if over.any() else tau,
        "nothing-within-the-limits": right if over.any() else 0.0 * tau,
        "first-limit-typed-in": np.clip(tau, -87.0, 87.0),
        "rounded-off": limits * np.tanh(tau / limits),
        "all-positive": np.minimum(np.abs(tau), limits),
        "first-joint-only": np.append(right[0], tau[1:]),
    }


@row.right  # The median of three.
def _(tau, limits):
    return np.median([-limits, tau, limits], axis=0)


row.at_least_0(limits="limits in both directions")


row.spans(  # as small, or as large, as in the lab
    tau=(lambda tau: 0.05 * tau,),
)

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
    """above-only: your code clamps torques only at the upper limit. Clamp the torques
      at the lower limit too
    below-only: your code clamps torques only at the lower limit. Clamp the torques at
      the upper limit too
    sign-lost: your code clamps a torque below the negative limit to the positive limit.
      Clamp this torque to the negative limit instead
    limits-typed-in: your code uses the constants 87 and 12 N m, which are the limits of
      the Panda's motors. Use the argument `limits`, because another arm has other
      limits
    smallest-limit-for-all: your code uses the smallest limit for all joints. Use each
      motor's own limit
    all-scaled-down: your code scales down all seven torques if one torque exceeds its
      limit. Clamp only torques beyond their limits, because the motors can supply the
      other torques in full
    length-bounded: your code compares the norm of the torque vector with the limits.
      Compare each torque with its own limit
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
    """switched-off: your code sets a torque beyond its limit to 0. Clamp this torque to
      its limit, because the motor can still supply its maximum torque
    the-larger-one: your code returns the torque or its limit, whichever is larger in
      magnitude. Use the smaller magnitude with the sign of the torque
    always-full: your code returns the positive or the negative limit for every nonzero
      torque. A torque within the limits should not change
    one-over-stops-all: your code sets all seven torques to 0 if one torque exceeds its
      limit. Clamp only torques beyond their limits, because the motors can supply the
      other torques in full
    nothing-within-the-limits: your code returns 0 if all torques are within their
      limits. Torques within their limits should not change
    first-limit-typed-in: your code uses the limit 87 N m for all joints. Use each
      motor's own entry in `limits`
    all-positive: your code makes all torques positive. Keep the sign of each torque,
      because a motor can act in both directions
    rounded-off: your code returns `limits * tanh(tau / limits)`, which is a smooth
      saturation. A torque within the limits should not change
    first-joint-only: your code clamps only the torque of joint1. Clamp all seven
      torques, because every motor has a limit
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

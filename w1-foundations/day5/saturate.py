"""5.7 `saturate(tau, limits)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, rounded
from labkit.judge.argument_mistakes import FIRST_FOR_ALL

from .joints import ONE, TORQUE, seven

PANDA = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])

row = Row(TORQUE)
row.of_argument("limits", FIRST_FOR_ALL.called("one-limit-for-all"))


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
    """not-bounded: the torques come back as they are
    above-only: torques are bounded above and not below: -100 N m comes out as it is
    below-only: torques are bounded below and not above
    never-negative: torques are kept between 0 and the limit; a motor turns both ways
    sign-lost: a torque at its limit loses its sign
    limits-typed-in: the Panda's 87 and 12 N m are typed in; take them from limits,
      another arm has others
    smallest-limit-for-all: all joints get the smallest limit; each motor has its own
    all-scaled-down: one motor at its limit scales all seven down; the others can still
      give what they are asked for
    length-bounded: the length of the whole vector is compared with the limits; each
      motor knows its own torque only
    """
    length = max(np.linalg.norm(tau), 1e-300)
    return {
        "not-bounded": tau.copy(),
        "above-only": np.minimum(tau, limits),
        "below-only": np.maximum(tau, -limits),
        "never-negative": np.clip(tau, 0.0, limits),
        "sign-lost": np.where(np.abs(tau) > limits, limits, tau),
        "limits-typed-in": np.clip(tau, -PANDA, PANDA),
        "smallest-limit-for-all": np.clip(tau, -limits.min(), limits.min()),
        "all-scaled-down": tau / max(1.0, np.max(np.abs(tau) / limits)),
        "length-bounded": tau * np.minimum(1.0, limits / length),
    }


@row.wrongs
def _(tau, limits):
    """switched-off: a torque over its limit becomes 0; a motor then gives its limit
    always-full: every motor gives its limit, in one direction or the other; a torque
      within the limits stays as it is
    one-over-stops-all: one motor over its limit stops all seven; the others can still
      give what they are asked for
    nothing-within-the-limits: where all torques are within their limits, 0 comes back;
      they should stay as they are
    first-limit-typed-in: all joints get 87 N m, typed in; take each motor's own from
      limits
    all-positive: every torque has lost its sign; a motor turns both ways
    rounded-off: it is limits tanh(tau / limits), which is smooth; within the limits a
      torque stays as it is
    first-joint-only: only joint1 is limited; every motor has a limit
    """
    right = np.clip(tau, -limits, limits)
    over = np.abs(tau) > limits
    return {
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


row.at_least_0(limits="bounds on both sides")


row.spans(  # as small, or as large, as in the lab
    tau=(lambda tau: 0.05 * tau,),
)

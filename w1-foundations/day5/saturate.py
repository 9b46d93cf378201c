"""5.7 `saturate(tau, limits)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row

from .joints import ONE, TORQUE, seven

PANDA = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])

row = Row(TORQUE)


@row.inputs
def _(rng):
    yield 100.0 * ONE, PANDA
    yield draw.rounded(PANDA * rng.uniform(-0.9, 0.9, 7)), PANDA  # within the limits
    yield 0.0 * ONE, PANDA
    for _ in range(5):
        yield seven(rng, -120, 120), PANDA
    for _ in range(4):
        yield seven(rng, -60, 60), seven(rng, 10, 60)


@row.wrong
def not_bounded(tau, limits):
    """the torques come back as they are"""
    return tau.copy()


@row.wrong
def above_only(tau, limits):
    """torques are bounded above and not below: -100 Nm comes out as it is"""
    return np.minimum(tau, limits)


@row.wrong
def below_only(tau, limits):
    """torques are bounded below and not above"""
    return np.maximum(tau, -limits)


@row.wrong
def never_negative(tau, limits):
    """torques are kept between 0 and the limit; a motor turns both ways"""
    return np.clip(tau, 0.0, limits)


@row.wrong
def sign_lost(tau, limits):
    """a torque at its limit loses its sign"""
    return np.where(np.abs(tau) > limits, limits, tau)


@row.wrong
def limits_typed_in(tau, limits):
    """the Panda's 87 and 12 Nm are typed in; take them from limits, another arm has
    others"""
    return np.clip(tau, -PANDA, PANDA)


@row.wrong
def one_limit_for_all(tau, limits):
    """all joints get the first motor's limit; the small ones give 12 Nm"""
    return np.clip(tau, -limits[0], limits[0])


@row.wrong
def smallest_limit_for_all(tau, limits):
    """all joints get the smallest limit; each motor has its own"""
    return np.clip(tau, -limits.min(), limits.min())


@row.wrong
def all_scaled_down(tau, limits):
    """one motor at its limit scales all seven down; the others can still give what they
    are asked for"""
    return tau / max(1.0, np.max(np.abs(tau) / limits))


@row.wrong
def length_bounded(tau, limits):
    """the length of the whole vector is compared with the limits; each motor knows its
    own torque only"""
    return tau * np.minimum(1.0, limits / max(np.linalg.norm(tau), 1e-300))


@row.wrong
def switched_off(tau, limits):
    """a torque over its limit becomes 0; a motor then gives its limit"""
    return np.where(np.abs(tau) > limits, 0.0, tau)


@row.wrong
def always_full(tau, limits):
    """every motor gives its limit, in one direction or the other; a torque within the
    limits stays as it is"""
    return np.sign(tau) * limits


@row.wrong
def one_over_stops_all(tau, limits):
    """one motor over its limit stops all seven; the others can still give what they are
    asked for"""
    if np.any(np.abs(tau) > limits):
        return np.zeros(7)
    return tau.copy()


@row.wrong
def nothing_within_the_limits(tau, limits):
    """where all torques are within their limits, 0 comes back; they should stay as they
    are"""
    if np.all(np.abs(tau) <= limits):
        return np.zeros(7)
    return np.clip(tau, -limits, limits)


@row.wrong
def first_limit_typed_in(tau, limits):
    """all joints get 87 Nm, typed in; take each motor's own from limits"""
    return np.clip(tau, -87.0, 87.0)


@row.wrong
def all_positive(tau, limits):
    """every torque has lost its sign; a motor turns both ways"""
    return np.minimum(np.abs(tau), limits)


@row.wrong
def first_joint_only(tau, limits):
    """only joint1 is limited; every motor has a limit => the right one with joint1"""
    out = tau.copy()
    out[0] = np.clip(tau[0], -limits[0], limits[0])
    return out


@row.right  # The median of three.
def _(tau, limits):
    return np.median([-limits, tau, limits], axis=0)


@row.right  # By sign and size.
def _(tau, limits):
    return np.sign(tau) * np.minimum(np.abs(tau), limits)

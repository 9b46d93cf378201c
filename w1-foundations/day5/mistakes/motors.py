"""Mistakes with motors: tasks 5.8 `saturate`, 5.9 `fastest` and `servo_ctrl`."""

import numpy as np

from labkit.judge.mistake import Mistake
from robo47 import control
from robo47.checks import Array

PANDA = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])


def _scaled_down(tau: Array, limits: Array) -> Array:
    over = np.max(np.abs(tau) / limits, axis=1, keepdims=True)
    return tau / np.maximum(over, 1.0)


def _by_length(tau: Array, limits: Array) -> Array:
    length = np.linalg.norm(tau, axis=1, keepdims=True)
    return tau * np.minimum(1.0, limits / np.maximum(length, 1e-300))


def _over(tau: Array, limits: Array) -> Array:
    return np.any(np.abs(tau) > limits, axis=1, keepdims=True)


SATURATE = [
    Mistake(
        "not-bounded",
        "the torques come back as they are",
        lambda tau, limits: tau + 0.0 * limits,
    ),
    Mistake(
        "above-only",
        "torques are bounded above and not below: -100 Nm comes out as it is",
        np.minimum,
    ),
    Mistake(
        "below-only",
        "torques are bounded below and not above",
        lambda tau, limits: np.maximum(tau, -limits),
    ),
    Mistake(
        "never-negative",
        "torques are kept between 0 and the limit; a motor turns both ways",
        lambda tau, limits: np.clip(tau, 0.0, limits),
    ),
    Mistake(
        "sign-lost",
        "a torque at its limit loses its sign",
        lambda tau, limits: np.where(np.abs(tau) > limits, limits, tau),
    ),
    Mistake(
        "limits-typed-in",
        "the Panda's 87 and 12 Nm are typed in; take them from limits, another arm has "
        "others",
        lambda tau, limits: np.clip(tau, -PANDA, PANDA),
    ),
    Mistake(
        "one-limit-for-all",
        "all joints get the first motor's limit; the small ones give 12 Nm",
        lambda tau, limits: np.clip(tau, -limits[:, :1], limits[:, :1]),
    ),
    Mistake(
        "smallest-limit-for-all",
        "all joints get the smallest limit; each motor has its own",
        lambda tau, limits: np.clip(
            tau, -limits.min(1, keepdims=True), limits.min(1, keepdims=True)
        ),
    ),
    Mistake(
        "all-scaled-down",
        "one motor at its limit scales all seven down; the others can still give what "
        "they are asked for",
        _scaled_down,
    ),
    Mistake(
        "length-bounded",
        "the length of the whole vector is compared with the limits; each motor knows "
        "its own torque only",
        _by_length,
    ),
    Mistake(
        "switched-off",
        "a torque over its limit becomes 0; a motor then gives its limit",
        lambda tau, limits: np.where(np.abs(tau) > limits, 0.0, tau),
    ),
    Mistake(
        "always-full",
        "every motor gives its limit, in one direction or the other; a torque within "
        "the limits stays as it is",
        lambda tau, limits: np.sign(tau) * limits,
    ),
    Mistake(
        "one-over-stops-all",
        "one motor over its limit stops all seven; the others can still give what they "
        "are asked for",
        lambda tau, limits: np.where(_over(tau, limits), 0.0, tau),
    ),
    Mistake(
        "nothing-within-the-limits",
        "where all torques are within their limits, 0 comes back; they should stay as "
        "they are",
        lambda tau, limits: np.where(
            _over(tau, limits), np.clip(tau, -limits, limits), 0.0
        ),
    ),
    Mistake(
        "first-limit-typed-in",
        "all joints get 87 Nm, typed in; take each motor's own from limits",
        lambda tau, limits: np.clip(tau, -PANDA[0], PANDA[0]) + 0.0 * limits,
    ),
    Mistake(
        "all-positive",
        "every torque has lost its sign; a motor turns both ways",
        lambda tau, limits: np.minimum(np.abs(tau), limits),
    ),
]

FASTEST = [
    Mistake(
        "undamped-limit",
        "2 / h is the limit of a spring without a damper; critical damping breaks "
        "earlier, because the damper acts a step late",
        lambda h: 2.0 / h,
    ),
    Mistake(
        "one-over-h",
        "1 / h is a rule of thumb; ask when the step's eigenvalue reaches -1",
        lambda h: 1.0 / h,
    ),
    Mistake(
        "larger-root",
        "the quadratic equation has two roots, and the loop breaks at the smaller one",
        lambda h: 2.0 * (np.sqrt(2.0) + 1.0) / h,
    ),
    Mistake(
        "nyquist",
        "pi / h is how fast a signal may be to be seen at all, not to be controlled",
        lambda h: np.pi / h,
    ),
    Mistake(
        "factor-two-forgotten",
        "it is half as much as it should be",
        lambda h: (np.sqrt(2.0) - 1.0) / h,
    ),
    Mistake(
        "in-hertz",
        "this is in turns per second; asked is rad/s",
        lambda h: control.fastest(h) / (2.0 * np.pi),
    ),
    Mistake(
        "times-h",
        "it grows with the time step; a longer step must allow less",
        lambda h: 2.0 * (np.sqrt(2.0) - 1.0) * h,
    ),
]

SERVO = [
    Mistake(
        "damper-forgotten",
        "the servo's own damper is not made up for: it takes kd qd off the torque",
        lambda tau, q, qd, kp, kd: q + tau / kp,
    ),
    Mistake(
        "damper-sign",
        "the servo's damper is counted twice: kd qd has to be added to the torque",
        lambda tau, q, qd, kp, kd: q + (tau - kd * qd) / kp,
    ),
    Mistake(
        "angle-forgotten",
        "this is how far from q the command has to be; add q",
        lambda tau, q, qd, kp, kd: (tau + kd * qd) / kp,
    ),
    Mistake(
        "angle-sign",
        "the torque is taken off: a servo pulls towards its command",
        lambda tau, q, qd, kp, kd: q - (tau + kd * qd) / kp,
    ),
    Mistake(
        "damper-not-divided",
        "only tau is divided by kp; the damper's part is a torque as well",
        lambda tau, q, qd, kp, kd: q + tau / kp + kd * qd,
    ),
    Mistake(
        "times-stiffness",
        "the torque is multiplied by kp; a stiffer servo needs less of an angle",
        lambda tau, q, qd, kp, kd: q + (tau + kd * qd) * kp,
    ),
    Mistake(
        "torque-of-the-command",
        "this is the servo's torque if tau were its command, not the other way round",
        lambda tau, q, qd, kp, kd: kp * (tau - q) - kd * qd,
    ),
    Mistake(
        "gains-swapped",
        "kp and kd are swapped",
        lambda tau, q, qd, kp, kd: q + (tau + kp * qd) / kd,
    ),
    Mistake(
        "one-gain-for-all",
        "all joints get the first servo's kp; each has its own",
        lambda tau, q, qd, kp, kd: q + (tau + kd * qd) / kp[:, :1],
    ),
    Mistake(
        "angle-subtracted",
        "q is subtracted; the command is that far from q, so add it",
        lambda tau, q, qd, kp, kd: (tau + kd * qd) / kp - q,
    ),
    Mistake(
        "stiffness-forgotten",
        "a torque is added to an angle; kp turns one into the other",
        lambda tau, q, qd, kp, kd: q + tau + kd * qd,
    ),
]

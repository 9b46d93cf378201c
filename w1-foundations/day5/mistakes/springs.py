"""Mistakes with springs: tasks 5.1 `pd_torque`, 5.2 `gains`, 5.4, 5.5 `gravity_pd`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from robo47.checks import Array
from robo47.diagnose.mistake import Mistake, lifted

PD = [
    Mistake(
        "error-sign",
        "the spring pushes away from the goal: e is the goal minus the measured angle, "
        "so it enters with a plus",
        lambda e, ed, kp, kd: kd * ed - kp * e,
    ),
    Mistake(
        "velocity-error-sign",
        "the damper drives the motion: ed is the wanted minus the measured velocity, "
        "so it enters with a plus as well",
        lambda e, ed, kp, kd: kp * e - kd * ed,
    ),
    Mistake(
        "all-signs",
        "spring and damper both push away from the goal: every sign is wrong",
        lambda e, ed, kp, kd: -kp * e - kd * ed,
    ),
    Mistake(
        "damper-forgotten",
        "there is a spring, but no damper: the arm would swing for ever",
        lambda e, ed, kp, kd: kp * e,
    ),
    Mistake(
        "spring-forgotten",
        "there is a damper, but no spring: nothing pulls the joint to its goal",
        lambda e, ed, kp, kd: kd * ed,
    ),
    Mistake(
        "gains-swapped",
        "kp and kd are swapped: the spring has the damper's gain",
        lambda e, ed, kp, kd: kd * e + kp * ed,
    ),
    Mistake(
        "one-gain-for-all",
        "all joints get the first joint's gains; each has its own here",
        lambda e, ed, kp, kd: kp[:, :1] * e + kd[:, :1] * ed,
    ),
    Mistake(
        "in-degrees",
        "the errors are converted to degrees; the gains are per radian",
        lambda e, ed, kp, kd: np.rad2deg(kp * e + kd * ed),
    ),
    Mistake(
        "error-in-degrees",
        "e is converted to degrees and ed is not; the gains are per radian",
        lambda e, ed, kp, kd: kp * np.rad2deg(e) + kd * ed,
    ),
    Mistake(
        "summed-over-joints",
        "the joints are summed into one number; every joint has its own spring",
        lambda e, ed, kp, kd: np.broadcast_to(
            np.sum(kp * e + kd * ed, axis=1, keepdims=True), e.shape
        ),
    ),
]


def _two(first: Array, second: Array) -> Array:
    return np.stack(np.broadcast_arrays(first, second), axis=-1)


GAINS = [
    Mistake(
        "two-forgotten",
        "kd is zeta omega; the standard form has a factor of its own before them, "
        "and without it the joint is damped half as much as you asked",
        lambda w, z: _two(w**2, z * w),
    ),
    Mistake(
        "kp-is-omega",
        "kp is omega, not its square: compare the units, kp is in 1/s2",
        lambda w, z: _two(w, 2 * z * w),
    ),
    Mistake(
        "kd-is-omega",
        "kd is omega whatever zeta is, which is right for zeta = 0.5 alone. It tracks "
        "well and overshoots by a sixth",
        lambda w, z: _two(w**2, w),
    ),
    Mistake(
        "zeta-ignored",
        "kd does not depend on zeta: it is right for critical damping alone",
        lambda w, z: _two(w**2, 2 * w),
    ),
    Mistake("swapped", "kp and kd are swapped", lambda w, z: _two(2 * z * w, w**2)),
    Mistake(
        "root-of-omega",
        "kd has the square root of omega in it, as if omega were kp already",
        lambda w, z: _two(w**2, 2 * z * np.sqrt(w)),
    ),
    Mistake(
        "kd-with-omega-squared",
        "kd has omega squared in it: compare the units, kd is in 1/s",
        lambda w, z: _two(w**2, 2 * z * w**2),
    ),
    Mistake(
        "zeta-squared-in-kp",
        "kp has zeta in it; damping changes kd alone",
        lambda w, z: _two((z * w) ** 2, 2 * z * w),
    ),
    Mistake(
        "omega-in-turns",
        "omega is taken for turns per second and multiplied by 2 pi; it comes in rad/s",
        lambda w, z: _two((2 * np.pi * w) ** 2, 4 * np.pi * z * w),
    ),
]

SAG = [
    Mistake(
        "sags-upwards",
        "the arm rests above its goal; a spring that has to give +g is stretched, so "
        "the joint stays below",
        lambda q, g, kp: q + g / kp,
    ),
    Mistake(
        "times-stiffness",
        "gravity is multiplied by the stiffness: a stiffer spring would sag more",
        lambda q, g, kp: q - g * kp,
    ),
    Mistake(
        "goal-forgotten",
        "this is how far the arm sags; asked is where it then is",
        lambda q, g, kp: -g / kp,
    ),
    Mistake(
        "sag-only",
        "this is how far the arm sags; asked is where it then is",
        lambda q, g, kp: g / kp,
    ),
    Mistake(
        "stiffness-forgotten",
        "gravity's torque is taken for an angle; stiffness turns one into the other",
        lambda q, g, kp: q - g,
    ),
    Mistake(
        "one-gain-for-all",
        "all joints get the first joint's stiffness; each has its own here",
        lambda q, g, kp: q - g / kp[:, :1],
    ),
    Mistake(
        "does-not-sag",
        "the goal comes back as it is; a spring gives torque only where there is an "
        "error",
        lambda q, g, kp: q + 0.0 * g,
    ),
    Mistake(
        "sag-in-degrees",
        "the sag is in degrees, the goal in radians",
        lambda q, g, kp: q - np.rad2deg(g / kp),
    ),
    Mistake(
        "goal-scaled-too",
        "the goal is divided by the stiffness as well",
        lambda q, g, kp: (q - g) / kp,
    ),
]


def _held(spring: Callable[..., Array]) -> Callable[..., Array]:
    return lambda e, ed, kp, kd, g: spring(e, ed, kp, kd) + g


def _right(e: Array, ed: Array, kp: Array, kd: Array) -> Array:
    return kp * e + kd * ed


GRAVITY = [
    Mistake(
        "gravity-forgotten",
        "gravity's torque is not in it: these springs sag like those of 5.1",
        lambda e, ed, kp, kd, g: _right(e, ed, kp, kd),
    ),
    Mistake(
        "gravity-sign",
        "gravity's torque has the wrong sign: g is what the motors must give to hold "
        "the arm, and this pushes the arm down",
        lambda e, ed, kp, kd, g: _right(e, ed, kp, kd) - g,
    ),
    Mistake(
        "gravity-twice",
        "gravity's torque is in it twice",
        lambda e, ed, kp, kd, g: _right(e, ed, kp, kd) + 2 * g,
    ),
    Mistake(
        "gravity-through-the-gain",
        "gravity's torque goes through kp; it is a torque already",
        lambda e, ed, kp, kd, g: kp * (e + g) + kd * ed,
    ),
    Mistake(
        "springs-forgotten",
        "only gravity's torque is there: the arm floats and goes nowhere",
        lambda e, ed, kp, kd, g: g + 0.0 * e,
    ),
    Mistake(
        "gravity-through-both-gains",
        "gravity's torque is multiplied by the whole of it; torques add",
        lambda e, ed, kp, kd, g: _right(e, ed, kp, kd) * g,
    ),
    *lifted([replace(m) for m in PD], "gravity is right; in the springs, ", _held),
]

"""Mistakes with springs: tasks 5.1 `pd_torque`, 5.4 `sag_step`, 5.5 `gravity_pd`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array


def wrapped(angle: Array) -> Array:
    """Return angles taken to within half a turn of 0."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


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
        "there is a spring, but no damper: the arm would swing for long",
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
    Mistake(
        "error-wrapped",
        "e is taken to within +-pi; these joints have stops, so a whole turn is not "
        "the same as none",
        lambda e, ed, kp, kd: kp * wrapped(e) + kd * ed,
    ),
    Mistake(
        "damper-through-both-gains",
        "kd ed is multiplied by kp as well; kp and kd each have one error of their own",
        lambda e, ed, kp, kd: kp * (e + kd * ed),
    ),
    Mistake(
        "velocity-error-forgotten",
        "kd is added as it is: it becomes a torque once it is multiplied by ed",
        lambda e, ed, kp, kd: kp * e + kd,
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
    Mistake(
        "always-below",
        "gravity's sign is lost: where g is negative, the joint rests above its goal",
        lambda q, g, kp: q - np.abs(g) / kp,
    ),
    Mistake(
        "stiffness-squared",
        "gravity's torque is divided by kp twice: compare the units",
        lambda q, g, kp: q - g / kp**2,
    ),
    Mistake(
        "answer-wrapped",
        "the angle is taken to within +-pi; these joints have stops, so a whole turn "
        "is not the same as none, and joint6 goes beyond pi",
        lambda q, g, kp: wrapped(q - g / kp),
    ),
]


def _held(spring: Callable[..., Array]) -> Callable[..., Array]:
    return lambda e, ed, kp, kd, g: spring(e, ed, kp, kd) + g


def _right(e: Array, ed: Array, kp: Array, kd: Array) -> Array:
    return kp * e + kd * ed


def _at_goal(e: Array) -> Array:
    return np.all(e == 0.0, axis=1, keepdims=True)


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
    Mistake(
        "gravity-at-the-goal-only",
        "at the goal only gravity's torque is there, and elsewhere only the springs'; "
        "the arm has its weight everywhere, and its springs too",
        lambda e, ed, kp, kd, g: np.where(_at_goal(e), g, _right(e, ed, kp, kd)),
    ),
    Mistake(
        "gravity-at-rest-only",
        "gravity's torque is there only where ed is 0; a moving arm has its weight too",
        lambda e, ed, kp, kd, g: _right(e, ed, kp, kd) + g * (ed == 0.0),
    ),
    Mistake(
        "nothing-at-the-goal",
        "where e is 0, no torque comes back: the arm has its weight at the goal too",
        lambda e, ed, kp, kd, g: np.where(_at_goal(e), 0.0, _right(e, ed, kp, kd) + g),
    ),
    *lifted([replace(m) for m in PD], "gravity is right; in the springs, ", _held),
]

"""5.1 `pd_torque(e, ed, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge.row import Row

from .joints import (
    TORQUE,
    WRAPPED,
    one_gain,
    springs,
    springs_of_one_gain,
)

row = Row(TORQUE, held_out=[one_gain(springs_of_one_gain)])
row.inputs(springs)


@row.wrong(
    "error-sign",
    "the spring pushes away from the goal: e is the goal minus the measured angle, so "
    "it enters with a plus",
)
def _(e, ed, kp, kd):
    return kd * ed - kp * e


@row.wrong(
    "velocity-error-sign",
    "the damper drives the motion: ed is the wanted minus the measured velocity, so "
    "it enters with a plus as well",
)
def _(e, ed, kp, kd):
    return kp * e - kd * ed


@row.wrong(
    "all-signs", "spring and damper both push away from the goal: every sign is wrong"
)
def _(e, ed, kp, kd):
    return -kp * e - kd * ed


@row.wrong(
    "damper-forgotten", "there is a spring, but no damper: the arm would swing for long"
)
def _(e, ed, kp, kd):
    return kp * e


@row.wrong(
    "spring-forgotten",
    "there is a damper, but no spring: nothing pulls the joint to its goal",
)
def _(e, ed, kp, kd):
    return kd * ed


@row.wrong("gains-swapped", "kp and kd are swapped: the spring has the damper's gain")
def _(e, ed, kp, kd):
    return kd * e + kp * ed


@row.wrong(
    "one-gain-for-all", "all joints get the first joint's gains; each has its own here"
)
def _(e, ed, kp, kd):
    return kp[0] * e + kd[0] * ed


@row.wrong(
    "in-degrees", "the errors are converted to degrees; the gains are per radian"
)
def _(e, ed, kp, kd):
    return np.rad2deg(kp * e + kd * ed)


@row.wrong(
    "error-in-degrees",
    "e is converted to degrees and ed is not; the gains are per radian",
)
def _(e, ed, kp, kd):
    return kp * np.rad2deg(e) + kd * ed


@row.wrong(
    "summed-over-joints",
    "the joints are summed into one number; every joint has its own spring",
)
def _(e, ed, kp, kd):
    return np.full(7, kp @ e + kd @ ed)


row.of_argument("e", WRAPPED)


@row.wrong(
    "damper-through-both-gains",
    "kd ed is multiplied by kp as well; kp and kd each have one error of their own",
)
def _(e, ed, kp, kd):
    return kp * (e + kd * ed)


@row.wrong(
    "velocity-error-forgotten",
    "kd is added as it is: it becomes a torque once it is multiplied by ed",
)
def _(e, ed, kp, kd):
    return kp * e + kd


@row.right  # Gains as matrices.
def _(e, ed, kp, kd):
    return np.diag(np.broadcast_to(kp, 7)) @ e + np.diag(np.broadcast_to(kd, 7)) @ ed


@row.close("rounded")  # To 5 decimals.
def _(e, ed, kp, kd):
    return np.round(kp * e + kd * ed, 5)

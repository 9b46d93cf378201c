"""5.1 `pd_torque(e, ed, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .joints import TORQUE, WRAPPED, one_gain, springs, springs_of_one_gain

row = Row(TORQUE, held_out=[one_gain(springs_of_one_gain)])
row.inputs(springs)


@row.wrongs
def _(e, ed, kp, kd):
    """error-sign: the spring pushes away from the goal: e is the goal minus the
      measured angle, so it enters with a plus
    velocity-error-sign: the damper drives the motion: ed is the wanted minus the
      measured velocity, so it enters with a plus as well
    all-signs: spring and damper both push away from the goal: every sign is wrong
    damper-forgotten: there is a spring, but no damper: the arm would swing for long
    spring-forgotten: there is a damper, but no spring: nothing pulls the joint to its
      goal
    gains-swapped: kp and kd are swapped: the spring has the damper's gain
    one-gain-for-all: all joints get the first joint's gains; each has its own here
    summed-over-joints: the joints are summed into one number; every joint has its own
      spring
    in-degrees: the errors are converted to degrees; the gains are per radian
    error-in-degrees: e is converted to degrees and ed is not; the gains are per radian
    damper-through-both-gains: kd ed is multiplied by kp as well; kp and kd each have
      one error of their own
    velocity-error-forgotten: kd is added as it is: it becomes a torque once it is
      multiplied by ed
    mean-gains: all joints get the mean of the gains; each has its own here => the right
      one with mean(kp) and mean(kd)
    """
    return {
        "error-sign": kd * ed - kp * e,
        "velocity-error-sign": kp * e - kd * ed,
        "all-signs": -kp * e - kd * ed,
        "damper-forgotten": kp * e,
        "spring-forgotten": kd * ed,
        "gains-swapped": kd * e + kp * ed,
        "one-gain-for-all": lambda: kp[0] * e + kd[0] * ed,
        "summed-over-joints": lambda: np.full(7, kp @ e + kd @ ed),
        "in-degrees": np.rad2deg(kp * e + kd * ed),
        "error-in-degrees": kp * np.rad2deg(e) + kd * ed,
        "damper-through-both-gains": kp * (e + kd * ed),
        "velocity-error-forgotten": kp * e + kd,
        "mean-gains": np.mean(kp) * e + np.mean(kd) * ed,
    }


row.of_argument("e", WRAPPED)


@row.right  # Gains as matrices.
def _(e, ed, kp, kd):
    return np.diag(np.broadcast_to(kp, 7)) @ e + np.diag(np.broadcast_to(kd, 7)) @ ed


@row.close("rounded")  # To 5 decimals.
def _(e, ed, kp, kd):
    return np.round(kp * e + kd * ed, 5)


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 4e-07 * e,),
    ed=(lambda ed: 6e-08 * ed,),
    kp=(lambda kp: 300 * kp,),
    kd=(lambda kd: 30 * kd,),
)

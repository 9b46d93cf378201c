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


@row.wrong
def error_sign(e, ed, kp, kd):
    """the spring pushes away from the goal: e is the goal minus the measured angle, so
    it enters with a plus"""
    return kd * ed - kp * e


@row.wrong
def velocity_error_sign(e, ed, kp, kd):
    """the damper drives the motion: ed is the wanted minus the measured velocity, so it
    enters with a plus as well"""
    return kp * e - kd * ed


@row.wrong
def all_signs(e, ed, kp, kd):
    """spring and damper both push away from the goal: every sign is wrong"""
    return -kp * e - kd * ed


@row.wrong
def damper_forgotten(e, ed, kp, kd):
    """there is a spring, but no damper: the arm would swing for long"""
    return kp * e


@row.wrong
def spring_forgotten(e, ed, kp, kd):
    """there is a damper, but no spring: nothing pulls the joint to its goal"""
    return kd * ed


@row.wrong
def gains_swapped(e, ed, kp, kd):
    """kp and kd are swapped: the spring has the damper's gain"""
    return kd * e + kp * ed


@row.wrong
def one_gain_for_all(e, ed, kp, kd):
    """all joints get the first joint's gains; each has its own here"""
    return kp[0] * e + kd[0] * ed


@row.wrong
def in_degrees(e, ed, kp, kd):
    """the errors are converted to degrees; the gains are per radian"""
    return np.rad2deg(kp * e + kd * ed)


@row.wrong
def error_in_degrees(e, ed, kp, kd):
    """e is converted to degrees and ed is not; the gains are per radian"""
    return kp * np.rad2deg(e) + kd * ed


@row.wrong
def summed_over_joints(e, ed, kp, kd):
    """the joints are summed into one number; every joint has its own spring"""
    return np.full(7, kp @ e + kd @ ed)


row.of_argument("e", WRAPPED)


@row.wrong
def damper_through_both_gains(e, ed, kp, kd):
    """kd ed is multiplied by kp as well; kp and kd each have one error of their own"""
    return kp * (e + kd * ed)


@row.wrong
def velocity_error_forgotten(e, ed, kp, kd):
    """kd is added as it is: it becomes a torque once it is multiplied by ed"""
    return kp * e + kd


@row.wrong
def mean_gains(e, ed, kp, kd):
    """all joints get the mean of the gains; each has its own here => the right one with
    mean(kp) and mean(kd)"""
    return np.mean(kp) * e + np.mean(kd) * ed


@row.right  # Gains as matrices.
def _(e, ed, kp, kd):
    return np.diag(np.broadcast_to(kp, 7)) @ e + np.diag(np.broadcast_to(kd, 7)) @ ed


@row.close("rounded")  # To 5 decimals.
def _(e, ed, kp, kd):
    return np.round(kp * e + kd * ed, 5)

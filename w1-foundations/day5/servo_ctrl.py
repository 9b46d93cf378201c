"""5.9 `servo_ctrl(tau, q, qd, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row

from .joints import ANGLE, ONE, seven

row = Row(ANGLE)


@row.inputs
def _(rng):
    kp = np.array([4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0])
    yield 0.0 * ONE, draw.READY, 0.0 * ONE, kp, kp / 10
    for q in draw.configurations(rng, 9):
        tau, qd = seven(rng, -40, 40), seven(rng, -2, 2)
        yield tau, q, qd, seven(rng, 500, 4500), seven(rng, 50, 450)


@row.wrong
def damper_forgotten(tau, q, qd, kp, kd):
    """the servo's own damper is not made up for: it takes kd qd off the torque"""
    return q + tau / kp


@row.wrong
def damper_sign(tau, q, qd, kp, kd):
    """the servo's damper is counted twice: kd qd has to be added to the torque"""
    return q + (tau - kd * qd) / kp


@row.wrong
def angle_forgotten(tau, q, qd, kp, kd):
    """this is how far from q the command has to be; add q"""
    return (tau + kd * qd) / kp


@row.wrong
def angle_sign(tau, q, qd, kp, kd):
    """the torque is taken off: a servo pulls towards its command"""
    return q - (tau + kd * qd) / kp


@row.wrong
def damper_not_divided(tau, q, qd, kp, kd):
    """only tau is divided by kp; the damper's part is a torque as well"""
    return q + tau / kp + kd * qd


@row.wrong
def times_stiffness(tau, q, qd, kp, kd):
    """the torque is multiplied by kp; a stiffer servo needs less of an angle"""
    return q + (tau + kd * qd) * kp


@row.wrong
def torque_of_the_command(tau, q, qd, kp, kd):
    """this is the servo's torque if tau were its command, not the other way round"""
    return kp * (tau - q) - kd * qd


@row.wrong
def gains_swapped(tau, q, qd, kp, kd):
    """kp and kd are swapped"""
    return q + (tau + kp * qd) / kd


@row.wrong
def one_gain_for_all(tau, q, qd, kp, kd):
    """all joints get the first servo's kp; each has its own"""
    return q + (tau + kd * qd) / kp[0]


@row.wrong
def angle_subtracted(tau, q, qd, kp, kd):
    """q is subtracted; the command is that far from q, so add it"""
    return (tau + kd * qd) / kp - q


@row.wrong
def stiffness_forgotten(tau, q, qd, kp, kd):
    """a torque is added to an angle; kp turns one into the other"""
    return q + tau + kd * qd

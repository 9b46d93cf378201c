"""5.9 `servo_ctrl(tau, q, qd, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import FIRST_FOR_ALL
from robo47 import panda

from .joints import ANGLE, ONE, seven

row = Row(ANGLE)
row.of_argument("kp", FIRST_FOR_ALL.called("one-gain-for-all"))


@row.inputs
def _(rng):
    kp = np.array([4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0])
    yield 0.0 * ONE, panda.READY_Q, 0.0 * ONE, kp, kp / 10
    for q in rng.configurations(9):
        tau, qd = seven(rng, -40, 40), seven(rng, -2, 2)
        yield tau, q, qd, seven(rng, 500, 4500), seven(rng, 50, 450)


@row.wrongs
def _(tau, q, qd, kp, kd):
    """damper-forgotten: the servo's own damper is not made up for: it takes kd qd off
      the torque
    damper-sign: the servo's damper is counted twice: kd qd has to be added to the
      torque
    angle-forgotten: this is how far from q the command has to be; add q
    angle-sign: the torque is taken off: a servo pulls towards its command
    damper-not-divided: only tau is divided by kp; the damper's part is a torque as well
    times-stiffness: the torque is multiplied by kp; a stiffer servo needs less of an
      angle
    torque-of-the-command: this is the servo's torque if tau were its command, not the
      other way round
    gains-swapped: kp and kd are swapped
    angle-subtracted: q is subtracted; the command is that far from q, so add it
    stiffness-forgotten: a torque is added to an angle; kp turns one into the other
    """
    return {
        "damper-forgotten": q + tau / kp,
        "damper-sign": q + (tau - kd * qd) / kp,
        "angle-forgotten": (tau + kd * qd) / kp,
        "angle-sign": q - (tau + kd * qd) / kp,
        "damper-not-divided": q + tau / kp + kd * qd,
        "times-stiffness": q + (tau + kd * qd) * kp,
        "torque-of-the-command": kp * (tau - q) - kd * qd,
        "gains-swapped": q + (tau + kp * qd) / kd,
        "angle-subtracted": (tau + kd * qd) / kp - q,
        "stiffness-forgotten": q + tau + kd * qd,
    }


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 0.002 * qd,),
)

"""5.9 `servo_ctrl(tau, q, qd, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from robo47 import panda

from .joints import ANGLE, ONE, seven

row = Row(ANGLE)


@row.inputs
def _(rng):
    kp = np.array([4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0])
    yield 0.0 * ONE, panda.READY_Q, 0.0 * ONE, kp, kp / 10
    for q in rng.configurations(9):
        tau, qd = seven(rng, -40, 40), seven(rng, -2, 2)
        yield tau, q, qd, seven(rng, 500, 4500), seven(rng, 50, 450)


@row.wrongs
def _(tau, q, qd, kp, kd):
    """damper-not-divided: only `tau` is divided by kp in your result. Divide the sum of
      `tau` and kd qd by kp, because kd qd is also a torque
    torque-of-the-command: your code returns the torque of a servo whose command is
      `tau`. Solve the servo equation for the command instead
    """
    return {
        "damper-not-divided": q + tau / kp + kd * qd,
        "torque-of-the-command": kp * (tau - q) - kd * qd,
    }


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 0.002 * qd,),
)

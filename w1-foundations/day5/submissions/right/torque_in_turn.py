# task 5.6: passed
# Column by column of M.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    acc = qdd_ref + kp * e + kd * ed
    tau = bias + qd * damping
    for j in range(7):
        tau = tau + M[:, j] * acc[j]
    return tau

# task 5.6: rounded-somewhere
# M in single precision.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return (
        np.float64(np.float32(M)) @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd
    )

# task 5.6: diagonal-of-M
# Only the diagonal.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return np.diag(M) * (qdd_ref + kd * ed + kp * e) + bias + damping * qd

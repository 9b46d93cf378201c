# task 5.6: friction-twice
# Friction twice.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return M @ (qdd_ref + kd * ed + kp * e) + bias + 2 * damping * qd

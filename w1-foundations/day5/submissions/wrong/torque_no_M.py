# task 5.6: M-forgotten
# No M.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return qdd_ref + kd * ed + kp * e + bias + damping * qd

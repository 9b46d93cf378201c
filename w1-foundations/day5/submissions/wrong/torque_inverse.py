# task 5.6: inverse-of-M
# Forward dynamics in mind.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return np.linalg.solve(M, qdd_ref + kd * ed + kp * e) + bias + damping * qd

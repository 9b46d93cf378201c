# task 5.6: bias-alone-at-the-goal
# Nothing but bias without an error.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    if not np.any(e):
        return bias.copy()
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd

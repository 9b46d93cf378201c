# task 5.6: qdd-ref-forgotten
# No feedforward.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return M @ (kd * ed + kp * e) + bias + damping * qd

# task 5.6: gains-outside-M
# The public page.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return M @ qdd_ref + bias + damping * qd + kp * e + kd * ed

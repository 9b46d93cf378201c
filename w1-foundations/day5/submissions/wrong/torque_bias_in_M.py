# task 5.6: bias-through-M
# bias inside the product.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return M @ (qdd_ref + kd * ed + kp * e + bias) + damping * qd

# task 5.6: measured-velocity-damped
# -kd qd: no reference velocity.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return M @ (qdd_ref - kd * qd + kp * e) + bias + damping * qd

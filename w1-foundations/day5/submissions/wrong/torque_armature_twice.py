# task 5.6: armature-twice
# The armature once more.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    M = M + 0.1 * np.eye(7)
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd

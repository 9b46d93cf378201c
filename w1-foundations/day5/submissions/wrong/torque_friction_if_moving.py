# task 5.6: off
# Friction only where the reference speeds up.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    d = damping if np.any(qdd_ref) else 0 * damping
    return M @ (qdd_ref + kd * ed + kp * e) + bias + d * qd

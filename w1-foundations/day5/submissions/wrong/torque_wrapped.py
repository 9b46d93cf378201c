# task 5.6: error-wrapped (not in a run: no error there is half a turn)
# e within half a turn.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    e = (e + np.pi) % (2 * np.pi) - np.pi
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd

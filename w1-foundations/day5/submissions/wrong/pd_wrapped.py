# task 5.1: error-wrapped (not in a run: no error there is half a turn)
# e within half a turn.
import numpy as np


def pd_torque(e, ed, kp, kd):
    e = (e + np.pi) % (2 * np.pi) - np.pi
    return kp * e + kd * ed

# task 5.5: error-wrapped (not in a run: no error there is half a turn)
# e within half a turn.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    e = (e + np.pi) % (2 * np.pi) - np.pi
    return kp * e + kd * ed + g_at_q

# task 5.5: shares-its-argument (not in a run: the numbers are right)
# Hands its argument back at the goal.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    if not np.any(e) and not np.any(ed):
        return g_at_q
    return kp * e + kd * ed + g_at_q

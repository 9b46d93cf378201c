# task 5.5: gravity-at-rest-only
# Gravity where a joint does not move.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return kp * e + kd * ed + g_at_q * (np.abs(ed) < 1e-9)

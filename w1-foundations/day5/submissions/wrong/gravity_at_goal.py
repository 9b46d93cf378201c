# task 5.5: gravity-at-the-goal-only
# Either gravity or the springs.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    if np.allclose(e, 0):
        return g_at_q.copy()
    return kp * e + kd * ed

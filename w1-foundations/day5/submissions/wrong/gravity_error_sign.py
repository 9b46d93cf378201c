# task 5.5: error-sign
# The sign of 5.1 once more.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return kd * ed - kp * e + g_at_q

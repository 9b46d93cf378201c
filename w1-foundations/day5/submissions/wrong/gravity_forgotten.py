# task 5.5: gravity-forgotten
# PD again.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return kp * e + kd * ed

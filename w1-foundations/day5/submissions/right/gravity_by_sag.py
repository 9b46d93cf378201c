# task 5.5: passed
# The spring is told to go higher.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return kp * (e + g_at_q / kp) + kd * ed

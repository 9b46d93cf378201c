# task 5.5: gravity-through-the-gain
# g added to e.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return pd_torque(e + g_at_q, ed, kp, kd)


def pd_torque(e, ed, kp, kd):
    return kp * e + kd * ed

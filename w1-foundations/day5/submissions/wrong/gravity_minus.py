# task 5.5: gravity-sign
# Gravity pulls down, so minus.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return pd_torque(e, ed, kp, kd) - g_at_q


def pd_torque(e, ed, kp, kd):
    return kp * e + kd * ed

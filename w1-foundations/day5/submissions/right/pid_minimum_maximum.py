# task 5.7: passed
# minimum and maximum.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.maximum(-clamp, np.minimum(clamp, e * dt + integral))
    return ki * new + kd * ed + kp * e, new

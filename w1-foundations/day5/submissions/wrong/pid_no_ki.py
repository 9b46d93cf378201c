# task 5.7: ki-forgotten
# No ki.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + integral, integral

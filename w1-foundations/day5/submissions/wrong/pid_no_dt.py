# task 5.7: dt-forgotten
# e, not e dt.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral

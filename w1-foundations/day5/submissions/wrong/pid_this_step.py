# task 5.7: this-step-alone-used
# ki e dt.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * e * dt, new

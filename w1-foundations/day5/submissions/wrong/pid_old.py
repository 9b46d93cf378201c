# task 5.7: old-integral-used
# Uses the old one.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, new

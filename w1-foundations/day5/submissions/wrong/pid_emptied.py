# task 5.7: emptied-at-the-limit
# Begins anew at the limit.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, 0.0, raw)
    return kp * e + kd * ed + ki * new, new

# task 5.7: divided-by-dt
# e / dt.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e / dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

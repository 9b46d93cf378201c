# task 5.7: old-sum-clamped
# Bounds first, adds then.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral, -clamp, clamp) + e * dt
    return kp * e + kd * ed + ki * new, new

# task 5.7: old-sum-clamped
# Bounds both, adds then.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral, -clamp, clamp) + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

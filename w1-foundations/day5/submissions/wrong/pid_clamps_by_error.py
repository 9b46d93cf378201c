# task 5.7: integral-wrong (not in a run: where the clamp matters there, the error is larger than it)
# Bounds while the error is large.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = integral + e * dt
    if np.max(np.abs(e)) >= clamp:
        new = np.clip(new, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

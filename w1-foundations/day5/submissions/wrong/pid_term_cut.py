# task 5.7: acceleration-wrong
# Bounds the term, and the integral apart.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = integral + e * dt
    term = np.clip(ki * new, -clamp, clamp)
    return kp * e + kd * ed + term, np.clip(new, -clamp, clamp)

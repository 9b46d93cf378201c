# task 5.7: integral-wrong
# Bounds where e and the integral agree.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    new = np.where(e * integral > 0, np.clip(raw, -clamp, clamp), raw)
    return kp * e + kd * ed + ki * new, new

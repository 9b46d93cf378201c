# task 5.7: term-clamped
# Bounds ki times the integral.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(ki * (integral + e * dt), -clamp, clamp) / ki
    return kp * e + kd * ed + ki * new, new

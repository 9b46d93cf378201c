# task 5.7: frozen-at-the-limit
# Stops summing at the limit.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    new = np.where(np.abs(raw) > clamp, integral, raw)
    return kp * e + kd * ed + ki * new, new

# task 5.7: clamped-too-late
# Clips what it returns, uses the other.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    raw = integral + e * dt
    return kp * e + kd * ed + ki * raw, np.clip(raw, -clamp, clamp)

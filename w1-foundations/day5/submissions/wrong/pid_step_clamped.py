# task 5.7: step-clamped
# Bounds e dt.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = integral + np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

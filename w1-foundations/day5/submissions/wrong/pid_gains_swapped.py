# task 5.7: gains-swapped
# kd e + kp ed.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kd * e + kp * ed + ki * new, new

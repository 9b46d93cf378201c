# task 5.7: swapped
# The integral first.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return integral, kp * e + kd * ed + ki * integral

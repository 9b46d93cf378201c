# task 5.7: half-the-step
# Half a trapezium.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e / 2 * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

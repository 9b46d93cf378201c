# task 5.7: frozen-at-the-limit
# Never comes back from the limit.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.where(np.abs(integral) >= clamp, integral, integral + e * dt)
    return kp * e + kd * ed + ki * new, new

# task 5.7: clamped-on-one-side
# Upper bound only.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.minimum(integral + e * dt, clamp)
    return kp * e + kd * ed + ki * integral, integral

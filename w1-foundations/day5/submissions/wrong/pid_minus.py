# task 5.7: integral-sign
# Minus.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral - e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral

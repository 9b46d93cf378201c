# task 5.7: starts-anew
# Starts from zero at every call.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral

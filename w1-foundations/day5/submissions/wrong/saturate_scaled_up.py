# task 5.7: not-finite
# The worst joint to its limit, always.
import numpy as np


def saturate(tau, limits):
    k = np.max(np.abs(tau) / limits)
    return np.clip(tau / min(k, 1.0), -limits, limits)


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * integral, integral

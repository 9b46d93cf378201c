# task 5.7: not-clamped
# No anti-windup.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral = integral + e * dt
    return kp * e + kd * ed + ki * integral, integral

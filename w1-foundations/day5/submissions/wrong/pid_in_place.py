# task 5.7: argument-changed
# += on the argument.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    integral += e * dt
    np.clip(integral, -clamp, clamp, out=integral)
    return kp * e + kd * ed + ki * integral, integral.copy()

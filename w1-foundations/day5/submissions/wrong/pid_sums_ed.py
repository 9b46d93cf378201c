# task 5.7: velocity-error-summed
# ed for e.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + ed * dt, -clamp, clamp)
    return kp * e + kd * ed + ki * new, new

# task 5.7: spring-forgotten
# No kp e.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.clip(integral + e * dt, -clamp, clamp)
    return kd * ed + ki * new, new

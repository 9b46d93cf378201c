# task 5.7: passed
# A list of two.
import numpy as np


def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
    new = np.array([min(max(i + x * dt, -clamp), clamp) for i, x in zip(integral, e)])
    return [kp * e + kd * ed + ki * new, new]

# task 7.2: peak-of-the-cubic
# The quintic's peak speed, the cubic's acceleration.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    dq = np.abs(dq)
    by_speed = 15 / 8 * dq / v_max
    by_acceleration = np.sqrt(6 * dq / a_max)
    return max(by_speed.max(), by_acceleration.max())

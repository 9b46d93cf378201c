# task 7.2: peak-of-the-cubic
# Both peaks of the cubic.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.5 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(6 * np.abs(dq) / a_max)
    return max(by_speed.max(), by_acceleration.max())

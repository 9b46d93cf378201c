# task 7.2: peak-acceleration
# 10/3 for 10/sqrt(3).
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(10 / 3 * np.abs(dq) / a_max)
    return max(by_speed.max(), by_acceleration.max())

# task 7.2: one-limit-for-all
# The lowest limits.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max.min()
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(dq) / a_max.min())
    return max(by_speed.max(), by_acceleration.max())

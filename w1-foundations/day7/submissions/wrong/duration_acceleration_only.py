# task 7.2: acceleration-only
# The speed was never written.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(dq) / a_max)
    return by_acceleration.max()

# task 7.2: shorter-of-two
# min for max.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(dq) / a_max)
    return np.minimum(by_speed, by_acceleration).max()

# task 7.2: shape
# Forgot to choose.
import numpy as np


def quintic_duration(delta_q, v_max, a_max):
    by_speed = 1.875 * np.abs(delta_q) / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(delta_q) / a_max)
    return np.maximum(by_speed, by_acceleration)

# task 7.2: longest-way
# The joint with the longest way.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(dq) / a_max)
    return max(by_speed[np.argmax(abs(dq))], by_acceleration[np.argmax(abs(dq))])

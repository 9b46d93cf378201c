# task 7.2: average-speed
# Way over speed.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.0 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * np.abs(dq) / a_max)
    return max(by_speed.max(), by_acceleration.max())

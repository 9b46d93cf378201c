# task 7.2: root-forgotten
# T for T squared.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = 10 / 3**0.5 * np.abs(dq) / a_max
    return max(by_speed.max(), by_acceleration.max())

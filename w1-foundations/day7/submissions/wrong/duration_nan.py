# task 7.2: ways-signed
# A root of negative ways.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * dq / v_max
    by_acceleration = np.sqrt(10 / 3**0.5 * dq / a_max)
    return max(by_speed.max(), by_acceleration.max())

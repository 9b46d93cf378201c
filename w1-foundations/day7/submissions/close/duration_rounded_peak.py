# task 7.2: rounded-somewhere
# 5.7735 for 10 / sqrt(3), 1.875 exact.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    by_speed = 1.875 * np.abs(dq) / v_max
    by_acceleration = np.sqrt(5.77350 * np.abs(dq) / a_max)
    return max(by_speed.max(), by_acceleration.max())

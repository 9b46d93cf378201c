# task 7.2: one-length
# One length for all joints, and the lowest limits.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    way = np.linalg.norm(dq)
    by_acceleration = np.sqrt(10 / np.sqrt(3) * way / a_max.min())
    return max(15 / 8 * way / v_max.min(), by_acceleration)

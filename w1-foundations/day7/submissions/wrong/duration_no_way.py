# task 7.2: no-way (not in a run: all of its moves have a way)
# 1 s where there is nothing to do.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    dq = np.abs(dq)
    if not dq.any():
        return 1.0
    by_acceleration = np.sqrt(10 / np.sqrt(3) * dq / a_max)
    return max((15 / 8 * dq / v_max).max(), by_acceleration.max())

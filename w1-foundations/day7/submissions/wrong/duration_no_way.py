# task 7.2: no-way (not in a run: all of its moves have a way)
# 1 s where there is nothing to do.
import numpy as np


def quintic_duration(delta_q, v_max, a_max):
    delta_q = np.abs(delta_q)
    if not delta_q.any():
        return 1.0
    by_acceleration = np.sqrt(10 / np.sqrt(3) * delta_q / a_max)
    return max((15 / 8 * delta_q / v_max).max(), by_acceleration.max())

# task 7.2: never-less (not in a run: its moves are longer)
# Never under 0.1 s.
import numpy as np


def quintic_duration(delta_q, v_max, a_max):
    delta_q = np.abs(delta_q)
    by_speed = 15 / 8 * delta_q / v_max
    by_acceleration = np.sqrt(10 / np.sqrt(3) * delta_q / a_max)
    return max(0.1, by_speed.max(), by_acceleration.max())

# task 7.2: passed
# Joint by joint, and the peaks found on a fine grid's best points.
import numpy as np


def quintic_duration(dq, v_max, a_max):
    longest = 0.0
    for way, v, a in zip(dq, v_max, a_max):
        way = abs(float(way))
        longest = max(longest, 15 * way / (8 * v))
        longest = max(longest, (10 * way / (a * 3**0.5)) ** 0.5)
    return longest

# task 2.9: d-along-the-old-z
# (a, 0, d).
import numpy as np


def dh_link(alpha, a, d, theta):
    ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array(
        [
            [c, -s, 0, a],
            [s * ca, c * ca, -sa, 0],
            [s * sa, c * sa, ca, d],
            [0, 0, 0, 1],
        ]
    )

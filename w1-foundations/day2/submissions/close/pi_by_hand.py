# task 2.9: rounded-somewhere
# Angles through degrees, with a typed pi.
import numpy as np


def dh_link(alpha, a, d, theta):
    alpha, theta = alpha * 180 / np.pi, theta * 180 / np.pi
    alpha, theta = alpha * 3.1415926 / 180, theta * 3.1415926 / 180
    ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array(
        [
            [c, -s, 0, a],
            [s * ca, c * ca, -sa, -d * sa],
            [s * sa, c * sa, ca, d * ca],
            [0, 0, 0, 1],
        ]
    )

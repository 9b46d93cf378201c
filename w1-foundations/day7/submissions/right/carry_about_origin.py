# task 7.8: passed
# About the frame's origin first, then to the common centre.
import numpy as np


def carry(m1, c1, I1, m2, c2, I2):
    def hat(v):
        x, y, z = v
        return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])

    m = m1 + m2
    c = (m1 * c1 + m2 * c2) / m
    about = I1 - m1 * hat(c1) @ hat(c1) + I2 - m2 * hat(c2) @ hat(c2)
    i = about + m * hat(c) @ hat(c)
    return np.r_[m, c, np.diag(i), i[0, 1], i[0, 2], i[1, 2]]

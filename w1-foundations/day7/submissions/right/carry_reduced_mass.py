# task 7.8: passed
# The reduced mass and the distance of the two.
import numpy as np


def carry(m1, c1, I1, m2, c2, I2):
    d = c2 - c1
    mu = m1 * m2 / (m1 + m2)
    i = I1 + I2 + mu * (np.dot(d, d) * np.eye(3) - d[:, None] * d[None, :])
    c = c1 + m2 / (m1 + m2) * d
    return [
        m1 + m2,
        c[0],
        c[1],
        c[2],
        i[0, 0],
        i[1, 1],
        i[2, 2],
        i[0, 1],
        i[0, 2],
        i[1, 2],
    ]

# task 7.8: first-centre-kept
# The link's centre.
import numpy as np


def carry(m1, c1, I1, m2, c2, I2):
    m = m1 + m2
    c = c1
    d1, d2 = c1 - c, c2 - c

    def steiner(mass, d):
        return mass * (d @ d * np.eye(3) - np.outer(d, d))

    i = I1 + steiner(m1, d1) + I2 + steiner(m2, d2)
    return np.array([m, *c, i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])

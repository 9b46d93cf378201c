# task 7.8: total-mass-for-each
# The whole mass in both.
import numpy as np


def carry(m1, c1, I1, m2, c2, I2):
    m = m1 + m2
    c = (m1 * c1 + m2 * c2) / m

    def steiner(mass, d):
        return mass * (d @ d * np.eye(3) - np.outer(d, d))

    i = I1 + steiner(m, c1 - c) + I2 + steiner(m, c2 - c)
    return np.array([m, *c, i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])

# task 7.8: shape
# The inertia as a matrix.
import numpy as np


def combine_bodies(m1, c1, I1, m2, c2, I2):
    m = m1 + m2
    c = (m1 * c1 + m2 * c2) / (m1 + m2)
    d1, d2 = c1 - c, c2 - c

    def steiner(mass, d):
        return mass * (d @ d * np.eye(3) - np.outer(d, d))

    i = I1 + steiner(m1, d1) + I2 + steiner(m2, d2)
    return np.array([m, *c, *i.ravel()])

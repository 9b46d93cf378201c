# task 1.2: draws-itself
# Random noise on the angle.
import numpy as np


def Rz(theta):
    theta = theta + 1e-3 * np.random.default_rng().normal()
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
